// A scene that was changed here and on disk: both texts side by side, and a way out that loses neither.

import { MergeView } from "@codemirror/merge";
import { EditorState } from "@codemirror/state";
import { EditorView, lineNumbers } from "@codemirror/view";
import { h } from "../dom";
import { hryLanguage } from "../editor/language";
import { openDialog } from "./dialog";

export type Resolution = "mine" | "disk" | "copy" | null;

/** Shows both texts and asks what is to become of them; null where the user decides later. */
export function openConflict(doc: string, mine: string, disk: string | null, title?: string, action = "Save mine"): Promise<Resolution> {
  return new Promise((resolve) => {
    let answer: Resolution = null;
    const dialog = openDialog(title ?? (disk === null ? `${doc} is gone from disk` : `${doc} was changed here and on disk`), {
      class: "conflict",
      closed: () => {
        merge.destroy();
        resolve(answer);
      },
    });
    const choose = (resolution: Resolution) => () => {
      answer = resolution;
      dialog.close();
    };
    const shown = [lineNumbers(), hryLanguage(), EditorState.readOnly.of(true), EditorView.lineWrapping];
    const parent = h("div", { class: "conflict-texts" });
    dialog.body.append(
      h("p", { class: "quiet" }, "Whichever you choose, the other text is kept: you find it under “Not saved yet” when you open a scene."),
      h("div", { class: "conflict-heads", "aria-hidden": "true" }, h("span", {}, "Here"), h("span", {}, "On disk")),
      parent,
      h(
        "div",
        { class: "actions" },
        h("button", { type: "button", class: "plain", onclick: dialog.close }, "Decide later"),
        h("button", { type: "button", class: "plain", "data-choice": "copy", onclick: choose("copy") }, "Save mine under another name"),
        disk === null ? null : h("button", { type: "button", class: "plain", "data-choice": "disk", onclick: choose("disk") }, "Take what is on disk"),
        h("button", { type: "button", class: "primary", "data-choice": "mine", onclick: choose("mine") }, action),
      ),
    );
    const merge = new MergeView({
      parent,
      a: { doc: mine, extensions: [shown, EditorView.contentAttributes.of({ "aria-label": "The text here", tabindex: "0" })] },
      b: { doc: disk ?? "", extensions: [shown, EditorView.contentAttributes.of({ "aria-label": "The text on disk", tabindex: "0" })] },
      collapseUnchanged: { margin: 3, minSize: 6 },
      gutter: true,
    });
  });
}
