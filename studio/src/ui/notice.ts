// One sentence over the picture: what went wrong and what to do, or that something was done.
import { el, icon } from './dom';

/** Milliseconds that good news stay, unless somebody has the pointer or the keyboard on them. */
const kStay = 5000;

export interface Notice {
  element: HTMLElement;
  complain(text: string): void;
  tell(text: string): void;
  hide(): void;
}

export function makeNotice(): Notice {
  const element = el('div', { class: 'notice', hidden: true });
  let timer = 0;
  const hide = () => {
    clearTimeout(timer);
    element.hidden = true;
  };
  const leave = () => {
    if (element.matches(':hover, :focus-within')) timer = setTimeout(leave, kStay);
    else hide();
  };
  const show = (text: string, watch: boolean) => {
    clearTimeout(timer);
    element.className = watch ? 'notice watch' : 'notice';
    element.setAttribute('role', watch ? 'alert' : 'status');
    element.replaceChildren(el('p', {}, text), el('button', { type: 'button', 'aria-label': 'Close', onclick: hide }, icon('close')));
    element.hidden = false;
    if (!watch) timer = setTimeout(leave, kStay);
  };
  return { element, hide, complain: (text) => show(text, true), tell: (text) => show(text, false) };
}
