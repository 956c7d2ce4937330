// Coloured code outside the editor: in tooltips and documentation.

import { highlightCode } from "@lezer/highlight";
import { h } from "../dom";
import { hryStream, look } from "./language";

/** A block of code in colours. */
export function codeBlock(source: string): HTMLElement {
  const block = h("pre", { class: "code" });
  highlightCode(
    source,
    hryStream.parser.parse(source),
    look,
    (text, style) => block.append(style ? h("span", { class: style }, text) : text),
    () => block.append("\n"),
  );
  return block;
}
