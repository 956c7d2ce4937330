// Dialogs, menus and passing words. Dialogs are the browser's own, which keep the focus inside and close with Escape.

import { fill, h, iconButton } from "../dom";

export interface Dialog {
  element: HTMLDialogElement;
  body: HTMLElement;
  close(): void;
}

/** Opens a dialog; it is gone from the page when it closes. */
export function openDialog(title: string, options: { class?: string; closed?: () => void } = {}): Dialog {
  const before = document.activeElement as HTMLElement | null;
  const body = h("div", { class: "dialog-body" });
  const element = h("dialog", { class: `dialog ${options.class ?? ""}`, "aria-label": title });
  const close = () => element.close();
  fill(
    element,
    h("div", { class: "dialog-head" }, h("h2", {}, title), iconButton("close", "Close", close, { key: "Esc" })),
    body,
  );
  element.addEventListener("close", () => {
    element.remove();
    options.closed?.();
    if (before?.isConnected) before.focus();
  });
  // A press on what is around it closes it.
  element.addEventListener("pointerdown", (event) => {
    if (event.target === element) close();
  });
  document.body.append(element);
  element.showModal();
  return { element, body, close };
}

/** Asks for a line of text; null where the user would rather not. */
export function ask(title: string, label: string, value: string, action: string, check: (text: string) => string | null): Promise<string | null> {
  return new Promise((resolve) => {
    let answer: string | null = null;
    const dialog = openDialog(title, { class: "narrow", closed: () => resolve(answer) });
    const input = h("input", { class: "field", id: "ask-field", value, spellcheck: "false", autocomplete: "off" });
    const trouble = h("p", { class: "trouble", role: "alert" });
    const form = h(
      "form",
      { class: "ask" },
      h("label", { for: "ask-field" }, label),
      input,
      trouble,
      h("div", { class: "actions" }, h("button", { type: "button", class: "plain", onclick: dialog.close }, "Cancel"), h("button", { type: "submit", class: "primary" }, action)),
    );
    form.addEventListener("submit", (event) => {
      event.preventDefault();
      const text = input.value.trim();
      const wrong = check(text);
      if (wrong) {
        trouble.textContent = wrong;
        return;
      }
      answer = text;
      dialog.close();
    });
    dialog.body.append(form);
    input.focus();
    input.select();
  });
}

/** Asks whether to do something. */
export function confirm(title: string, text: string, action: string): Promise<boolean> {
  return new Promise((resolve) => {
    let agreed = false;
    const dialog = openDialog(title, { class: "narrow", closed: () => resolve(agreed) });
    const yes = () => {
      agreed = true;
      dialog.close();
    };
    const button = h("button", { type: "button", class: "primary", onclick: yes }, action);
    dialog.body.append(h("p", {}, text), h("div", { class: "actions" }, h("button", { type: "button", class: "plain", onclick: dialog.close }, "Cancel"), button));
    button.focus();
  });
}

export interface MenuItem {
  label: string;
  hint?: string;
  run(): void;
}

/** Opens a menu under (or over) a button. */
export function openMenu(anchor: HTMLElement, items: MenuItem[], name: string): void {
  const open = document.querySelector<HTMLElement>(".menu");
  if (open) {
    const same = open.dataset["for"] === name;
    open.remove();
    if (same) return;
  }
  const menu = h("div", { class: "menu", role: "menu", "aria-label": name, "data-for": name });
  const close = (focus: boolean) => {
    menu.remove();
    document.removeEventListener("pointerdown", outside, true);
    anchor.setAttribute("aria-expanded", "false");
    if (focus) anchor.focus();
  };
  const outside = (event: Event) => {
    if (!menu.contains(event.target as Node) && !anchor.contains(event.target as Node)) close(false);
  };
  for (const item of items) {
    menu.append(
      h(
        "button",
        {
          type: "button",
          role: "menuitem",
          onclick: () => {
            close(true);
            item.run();
          },
        },
        h("span", {}, item.label),
        item.hint ? h("span", { class: "hint" }, item.hint) : null,
      ),
    );
  }
  menu.addEventListener("keydown", (event) => {
    const all = [...menu.querySelectorAll("button")];
    const at = all.indexOf(document.activeElement as HTMLButtonElement);
    if (event.key === "ArrowDown") all[(at + 1) % all.length]?.focus();
    else if (event.key === "ArrowUp") all[(at + all.length - 1) % all.length]?.focus();
    else if (event.key === "Home") all[0]?.focus();
    else if (event.key === "End") all.at(-1)?.focus();
    else if (event.key === "Escape") close(true);
    else if (event.key === "Tab") {
      close(true);
      return;
    } else return;
    event.preventDefault();
    event.stopPropagation();
  });
  (anchor.closest("dialog, .full-screen") ?? document.body).append(menu);
  placeBy(menu, anchor);
  anchor.setAttribute("aria-expanded", "true");
  document.addEventListener("pointerdown", outside, true);
  menu.querySelector("button")?.focus();
}

/** Puts something that floats beside an element, within the window. */
export function placeBy(floating: HTMLElement, anchor: Element | DOMRect): void {
  const box = anchor instanceof Element ? anchor.getBoundingClientRect() : anchor;
  const { offsetWidth: width, offsetHeight: height } = floating;
  const left = Math.max(8, Math.min(box.left, innerWidth - width - 8));
  const below = box.bottom + 6;
  const top = below + height + 8 <= innerHeight ? below : Math.max(8, box.top - height - 6);
  floating.style.left = `${left}px`;
  floating.style.top = `${top}px`;
}

/** The place for words that pass, and for those that are only heard. */
export class Words {
  readonly toasts = h("div", { class: "toasts", role: "status", "aria-live": "polite" });
  readonly live = h("div", { class: "unseen", role: "status", "aria-live": "polite", "aria-atomic": "true" });
  private timer = 0;

  /** Says something in passing. */
  say(text: string, action?: { label: string; run(): void }): void {
    const toast = h("div", { class: "toast" }, h("span", {}, text));
    const gone = () => toast.remove();
    if (action) {
      toast.append(
        h(
          "button",
          {
            type: "button",
            class: "plain",
            onclick: () => {
              gone();
              action.run();
            },
          },
          action.label,
        ),
      );
    }
    while (this.toasts.childElementCount >= 3) this.toasts.firstElementChild?.remove();
    this.toasts.append(toast);
    setTimeout(gone, action ? 12_000 : 4_500);
  }

  /** Tells a screen reader, once things have settled. */
  announce(text: string): void {
    clearTimeout(this.timer);
    this.timer = window.setTimeout(() => {
      this.live.textContent = text;
    }, 700);
  }
}
