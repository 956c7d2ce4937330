// The overlay of keys.

import { h, keyName } from "../dom";
import { openDialog } from "./dialog";

const groups: [string, [string[], string][]][] = [
  [
    "Everywhere",
    [
      [["Mod-O"], "Open a scene, an example, a new one"],
      [["Mod-S"], "Save the scene"],
      [["Mod-Shift-S"], "Save it under another name"],
      [["F6"], "To the next part: text, picture, problems, bar"],
      [["Alt-Space"], "Play or pause, where the scene moves"],
      [["Alt-←", "Alt-→"], "A step in time (in the picture)"],
      [["F1"], "This overview"],
    ],
  ],
  [
    "In the text",
    [
      [["Mod-Space"], "Complete: names, fields with their defaults"],
      [["Mod-."], "Take the fix that is offered here"],
      [["F8"], "To the next problem"],
      [["F12"], "To the definition; Escape closes the library"],
      [["F2"], "Rename, everywhere"],
      [["Shift-Alt-F"], "Lay the text out in the common style"],
      [["Alt-↑", "Alt-↓"], "Turn the number at the cursor; Shift: by ten"],
      [["Alt-C"], "Choose the colour at the cursor"],
      [["Mod-F"], "Find and replace"],
      [["Mod-/"], "Comment the lines, or take the comment away"],
      [["Escape", "Tab"], "Leave the text (Tab alone indents)"],
    ],
  ],
  [
    "In the picture",
    [
      [["↑", "↓", "←", "→"], "Move the pixel cursor; Shift: by ten"],
      [["Enter"], "Explain the pixel, and go to the line that made it"],
      [["+", "-", "0", "1"], "Closer, farther, fit, pixel for pixel"],
      [["C"], "Compare with the picture before: wipe, difference, off"],
      [["F"], "Full screen"],
    ],
  ],
];

export function openKeys(version: string): void {
  const dialog = openDialog("Keys", { class: "keys" });
  for (const [title, rows] of groups) {
    dialog.body.append(
      h(
        "section",
        {},
        h("h3", {}, title),
        h(
          "dl",
          {},
          ...rows.flatMap(([keys, what]) => [h("dt", {}, ...keys.flatMap((key, index) => [index > 0 ? " " : null, h("kbd", {}, keyName(key))])), h("dd", {}, what)]),
        ),
      ),
    );
  }
  dialog.body.append(
    h("p", { class: "quiet" }, "With the mouse or a finger: drag a number sideways to change it, click a swatch for another colour, click a pixel to have it explained, hold Ctrl and click a name to see its definition."),
    h("p", { class: "quiet" }, `hray ${version}`),
  );
}
