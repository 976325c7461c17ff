// One sentence over the picture: what went wrong and what to do, or that something was done.
import { el, icon } from './dom';

export interface Notice {
  element: HTMLElement;
  complain(text: string): void;
  tell(text: string): void;
  hide(): void;
}

export function makeNotice(): Notice {
  const element = el('div', { class: 'notice', hidden: true });
  const hide = () => (element.hidden = true);
  const show = (text: string, watch: boolean) => {
    element.className = watch ? 'notice watch' : 'notice';
    element.setAttribute('role', watch ? 'alert' : 'status');
    element.replaceChildren(el('p', {}, text), el('button', { type: 'button', 'aria-label': 'Close', onclick: hide }, icon('close')));
    element.hidden = false;
  };
  return { element, hide, complain: (text) => show(text, true), tell: (text) => show(text, false) };
}
