// Small helpers for building the page.

type Child = Node | string | null | undefined | false;
type Properties = Record<string, unknown>;

/** An element with properties (`on…` listeners, `data-…`/`aria-…` attributes, anything else an attribute) and children. */
export function h<K extends keyof HTMLElementTagNameMap>(
  tag: K,
  properties: Properties = {},
  ...children: Child[]
): HTMLElementTagNameMap[K] {
  const element = document.createElement(tag);
  for (const [name, value] of Object.entries(properties)) {
    if (value === null || value === undefined || value === false) continue;
    if (name.startsWith("on") && typeof value === "function") {
      element.addEventListener(name.slice(2), value as EventListener);
    } else if (name === "class") {
      element.className = String(value);
    } else {
      element.setAttribute(name, value === true ? "" : String(value));
    }
  }
  fill(element, ...children);
  return element;
}

/** Replaces the children of an element. */
export function fill(element: Element, ...children: Child[]): void {
  element.replaceChildren(...children.filter((child): child is Node | string => child !== null && child !== undefined && child !== false));
}

/** A drawing of 16 by 16 units, in strokes of the colour of the text around it. */
export function icon(path: string): SVGSVGElement {
  const svg = document.createElementNS("http://www.w3.org/2000/svg", "svg");
  svg.setAttribute("viewBox", "0 0 16 16");
  svg.setAttribute("class", "icon");
  svg.setAttribute("aria-hidden", "true");
  const stroke = document.createElementNS("http://www.w3.org/2000/svg", "path");
  stroke.setAttribute("d", path);
  svg.append(stroke);
  return svg;
}

export const icons = {
  open: "M2 4.5h4l1.5 1.5H14v6.5H2z",
  save: "M3 3h8l2 2v8H3z M5.5 3v3.5h4V3 M5 13V9.5h6V13",
  picture: "M2.5 3.5h11v9h-11z M2.5 11l3.2-3.4 2.6 2.7 1.9-1.8 3.3 3 M10.2 6.2v.1",
  link: "M6.5 9.5l3-3 M7.5 4.8l1.2-1.2a2.6 2.6 0 013.7 3.7l-1.2 1.2 M8.500 11.200l-1.200 1.200a2.600 2.600 0 01-3.700-3.700l1.200-1.200",
  help: "M6 6.200a2 2 0 113 1.700c-.7.400-1 .800-1 1.600 M8 12v.100",
  theme: "M8 2.500a5.500 5.500 0 100 11 5.500 5.500 0 000-11z M8 2.500v11 M8 5.200h3.900 M8 8h5.400 M8 10.800h3.900",
  play: "M5 3.500l7 4.500-7 4.500z",
  pause: "M5.500 3.500v9 M10.500 3.500v9",
  loop: "M3 8a4 4 0 014-4h4 M9.500 2.200L11.500 4 9.500 5.800 M13 8a4 4 0 01-4 4H5 M6.500 13.800L4.500 12l2-1.800",
  plus: "M8 3.500v9 M3.500 8h9",
  minus: "M3.500 8h9",
  compare: "M2.500 3.500h11v9h-11z M8 2v12",
  full: "M3 6V3h3 M10 3h3v3 M13 10v3h-3 M6 13H3v-3",
  close: "M4 4l8 8 M12 4l-8 8",
  down: "M4 6.500l4 4 4-4",
  right: "M6.500 4l4 4-4 4",
  copy: "M5.500 5.500h7.500v7.500H5.500z M3 10.500V3h7.500",
  command: "M3 4.500l3.500 3.500L3 11.500 M8 12h5",
  more: "M3.500 8v.100 M8 8v.100 M12.500 8v.100",
  bulb: "M6 12.500h4 M6.500 14.500h3 M5.800 10.500C4.700 9.700 4 8.600 4 7.200a4 4 0 118 0c0 1.400-.7 2.500-1.800 3.300z",
  pin: "M8 9.500v4.500 M5 9.500h6 M6 2.500h4 M6.500 2.500v4L5 9.500 M9.500 2.500v4l1.500 3",
  format: "M3 4h10 M3 7h6 M3 10h8 M3 13h5",
} as const;

/** A button with a drawing, its name for those who cannot see it, and the key that does the same. */
export function iconButton(
  drawing: keyof typeof icons,
  name: string,
  onclick: (event: MouseEvent) => void,
  options: { text?: string; key?: string; class?: string } = {},
): HTMLButtonElement {
  return h(
    "button",
    {
      type: "button",
      class: `button ${options.class ?? ""}`,
      "aria-label": name,
      title: options.key ? `${name} (${options.key})` : name,
      onclick,
    },
    icon(icons[drawing]) as unknown as Node,
    options.text ? h("span", { class: "button-text" }, options.text) : null,
  );
}

export const isMac = /Mac|iPad|iPhone/.test(navigator.platform);

/** How a key is called on this machine: `Mod-s` is Ctrl+S or ⌘S. */
export function keyName(key: string): string {
  if (key.length === 1) return key.toUpperCase();
  return key
    .split("-")
    .map((part) => {
      if (part === "Mod") return isMac ? "⌘" : "Ctrl";
      if (part === "Alt") return isMac ? "⌥" : "Alt";
      if (part === "Shift") return isMac ? "⇧" : "Shift";
      return part.length === 1 ? part.toUpperCase() : part.replace("Arrow", "");
    })
    .join(isMac ? "" : "+");
}

/** Hands the browser a file to keep. */
export function download(name: string, mime: string, bytes: BlobPart): void {
  const address = URL.createObjectURL(new Blob([bytes], { type: mime }));
  const link = h("a", { href: address, download: name });
  document.body.append(link);
  link.click();
  link.remove();
  setTimeout(() => URL.revokeObjectURL(address), 10_000);
}
