// Where to start from: a file of the folder (from the list or by its path), an example, an empty scene, a text that
// was not saved.

import { fill, h } from "../dom";
import type { Draft } from "../drafts";
import type { ExampleEntry, FileEntry } from "../engine/protocol";
import { openDialog } from "./dialog";

export interface OpenChoices {
  folder: string | null;
  files: FileEntry[];
  examples: ExampleEntry[];
  /** They take a moment to find, and what is typed meanwhile belongs to the dialog already. */
  drafts: Promise<Draft[]>;
  open(path: string): void;
  example(example: ExampleEntry): void;
  empty(): void;
  draft(draft: Draft): void;
  forget(draft: Draft): void;
}

/** How well a path fits what was typed: the lower the better, null where it does not. */
export function fits(path: string, typed: string): number | null {
  const low = path.toLowerCase();
  const wanted = typed.trim().toLowerCase();
  if (wanted === "") return 1;
  if (low === wanted) return 0;
  const name = low.slice(low.lastIndexOf("/") + 1);
  if (name.startsWith(wanted)) return 1;
  if (low.includes(wanted)) return 2;
  let at = 0;
  for (const character of wanted) {
    at = low.indexOf(character, at) + 1;
    if (at === 0) return null;
  }
  return 3;
}

export function openChooser(choices: OpenChoices, welcome: boolean): void {
  const dialog = openDialog(welcome ? "Where would you like to start?" : "Open", { class: "chooser" });
  const done = (run: () => void) => {
    dialog.close();
    run();
  };
  const input = h("input", {
    class: "field",
    type: "search",
    placeholder: choices.folder === null ? "Find an example" : "Find a scene, or type its path",
    "aria-label": choices.folder === null ? "Find an example" : "Find a scene, or type its path",
    spellcheck: "false",
    autocomplete: "off",
  });
  const content = h("div", { class: "chooser-content" });
  dialog.body.append(h("div", { class: "chooser-search" }, input), content);

  let unsaved: Draft[] = [];
  const draw = () => {
    const typed = input.value;
    const drafts = unsaved.filter((draft) => fits(draft.doc, typed) !== null);
    const files = choices.files
      .filter((file) => file.kind !== "other")
      .map((file) => ({ file, fit: fits(file.path, typed) }))
      .filter((one): one is { file: FileEntry; fit: number } => one.fit !== null)
      .sort((one, other) => one.fit - other.fit || (one.file.path < other.file.path ? -1 : 1))
      .map((one) => one.file);
    const examples = choices.examples.filter((example) => fits(`${example.name} ${example.title} ${example.about}`, typed) !== null);
    fill(
      content,
      drafts.length > 0
        ? section(
            "Not saved yet",
            h("ul", { class: "file-list" }, ...drafts.slice(0, 20).map((draft) =>
              h(
                "li",
                { class: "draft" },
                h("button", { type: "button", onclick: () => done(() => choices.draft(draft)) }, h("span", {}, draft.doc), h("span", { class: "hint" }, new Date(draft.at).toLocaleString())),
                h(
                  "button",
                  {
                    type: "button",
                    class: "plain",
                    "aria-label": `Throw away the unsaved text of ${draft.doc}`,
                    onclick: () => {
                      choices.forget(draft);
                      unsaved = unsaved.filter((one) => one !== draft);
                      draw();
                      input.focus();
                    },
                  },
                  "Throw away",
                ),
              ),
            )),
          )
        : null,
      choices.folder !== null
        ? section(
            `In ${choices.folder}`,
            files.length > 0
              ? h("ul", { class: "file-list" }, ...files.slice(0, 300).map((file) =>
                  h(
                    "li",
                    {},
                    h(
                      "button",
                      { type: "button", onclick: () => done(() => choices.open(file.path)) },
                      h("span", {}, file.path),
                      file.kind === "classic" ? h("span", { class: "hint" }, "classic") : null,
                    ),
                  ),
                ))
              : h("p", { class: "nothing" }, typed ? `No scene here fits “${typed}”. Enter tries it as a path.` : "There are no scenes in this folder yet."),
          )
        : null,
      examples.length > 0 || typed === ""
        ? section("Examples", h("div", { class: "cards" }, typed === "" ? emptyCard(() => done(choices.empty)) : null, ...examples.map((example) => card(example, () => done(() => choices.example(example))))))
        : null,
    );
  };
  input.addEventListener("input", draw);
  dialog.element.addEventListener("keydown", (event) => {
    if (event.key !== "ArrowDown" && event.key !== "ArrowUp") return;
    const all = [...content.querySelectorAll<HTMLElement>(".file-list li > button:first-child, .card")];
    const at = all.indexOf(document.activeElement as HTMLElement);
    const next = event.key === "ArrowDown" ? all[at + 1] : at <= 0 ? input : all[at - 1];
    next?.focus();
    event.preventDefault();
  });
  input.addEventListener("keydown", (event) => {
    if (event.key !== "Enter") return;
    event.preventDefault();
    const typed = input.value.trim().replace(/^\.\//, "");
    // A whole path is meant as it is, listed or not.
    const exact = typed.endsWith(".hry") || choices.files.some((file) => file.path === typed);
    const first = content.querySelector<HTMLElement>(".file-list li > button:first-child, .card");
    if (choices.folder !== null && typed !== "" && (exact || !first)) done(() => choices.open(typed));
    else first?.click();
  });
  draw();
  input.focus();
  void choices.drafts.then((found) => {
    unsaved = found;
    if (found.length > 0) draw();
  });
}

function section(title: string, body: HTMLElement): HTMLElement {
  return h("section", { class: "chooser-section" }, h("h3", {}, title), body);
}

function card(example: ExampleEntry, run: () => void): HTMLElement {
  return h(
    "button",
    { type: "button", class: "card", onclick: run, "data-example": example.name },
    example.picture
      ? h("img", { src: example.picture, alt: "", loading: "lazy", width: 320, height: 200 })
      : h("span", { class: "card-blank", "aria-hidden": "true" }),
    h("span", { class: "card-title" }, example.title, example.time ? h("span", { class: "badge" }, "moves") : null),
    h("span", { class: "card-about" }, example.about),
  );
}

function emptyCard(run: () => void): HTMLElement {
  return h(
    "button",
    { type: "button", class: "card", onclick: run, "data-example": "" },
    h("span", { class: "card-blank", "aria-hidden": "true" }, "+"),
    h("span", { class: "card-title" }, "A new scene"),
    h("span", { class: "card-about" }, "A ball on a floor, to change"),
  );
}
