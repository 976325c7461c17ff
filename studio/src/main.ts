import './style.css';
import { App } from './app';
import { el } from './ui/dom';
import { kCannotDraw } from './ui/words';
import { canDraw } from './view/stage';

const root = document.getElementById('app') as HTMLElement;
if (canDraw()) new App(root);
else root.replaceWith(el('main', { class: 'cannot', role: 'alert' }, el('h1', {}, 'tetsoup studio'), el('p', {}, kCannotDraw)));
