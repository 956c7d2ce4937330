// The little Markdown that documentation is written in: paragraphs, lists, code, emphasis. Built as elements, so that
// nothing in a text can become a tag.

import { h } from "./dom";

function inline(text: string): (Node | string)[] {
  const parts: (Node | string)[] = [];
  const pattern = /`([^`]+)`|\*\*([^*]+)\*\*|\*([^*\s][^*]*)\*|\[([^\]]+)\]\(([^)\s]+)\)/g;
  let last = 0;
  for (const found of text.matchAll(pattern)) {
    if (found.index > last) parts.push(text.slice(last, found.index));
    const [whole, code, strong, emphasis, label] = found;
    if (code) parts.push(h("code", {}, code));
    else if (strong) parts.push(h("strong", {}, strong));
    else if (emphasis) parts.push(h("em", {}, emphasis));
    else parts.push(label ?? whole);
    last = found.index + whole.length;
  }
  if (last < text.length) parts.push(text.slice(last));
  return parts;
}

/** A Markdown text as elements. `code` makes the element of a block of code. */
export function markdown(text: string, code: (source: string) => HTMLElement = (source) => h("pre", {}, source)): HTMLElement {
  const out = h("div", { class: "prose" });
  const lines = text.split("\n");
  let at = 0;
  while (at < lines.length) {
    const line = lines[at] ?? "";
    if (/^\s*$/.test(line)) {
      at++;
    } else if (/^\s*(```|~~~)/.test(line)) {
      const fence = line.trim().slice(0, 3);
      const source: string[] = [];
      for (at++; at < lines.length && !(lines[at] ?? "").trim().startsWith(fence); at++) source.push(lines[at] ?? "");
      at++;
      out.append(code(source.join("\n")));
    } else if (/^\s*[-*] /.test(line)) {
      const list = h("ul");
      for (; at < lines.length && /^\s*[-*] /.test(lines[at] ?? ""); at++) {
        list.append(h("li", {}, ...inline((lines[at] ?? "").replace(/^\s*[-*] /, ""))));
      }
      out.append(list);
    } else {
      const heading = /^#+ /.test(line);
      const words: string[] = [line.replace(/^#+ /, "")];
      for (at++; !heading && at < lines.length && !/^\s*$|^\s*(```|~~~)|^\s*[-*] |^#/.test(lines[at] ?? ""); at++) words.push(lines[at] ?? "");
      out.append(h("p", heading ? { class: "heading" } : {}, ...inline(words.join(" "))));
    }
  }
  return out;
}
