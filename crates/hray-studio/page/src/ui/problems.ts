// The problems below: one row each, which opens to the whole explanation and its fixes.

import { fill, h, icon, icons } from "../dom";
import type { Problem } from "../engine/protocol";

export interface ProblemsEvents {
  go(problem: Problem): void;
  fix(problem: Problem, index: number): void;
  position(problem: Problem): string;
}

export class ProblemsPanel {
  readonly element = h("div", { class: "problems" });
  private opened: string | null = null;

  constructor(private readonly events: ProblemsEvents) {
    this.show([]);
  }

  show(problems: readonly Problem[]): void {
    if (problems.length === 0) {
      this.opened = null;
      fill(this.element, h("p", { class: "nothing" }, "Nothing to mend. Errors and warnings appear here, with their explanation."));
      return;
    }
    const keys = problems.map((problem) => `${problem.code}:${problem.message}`);
    if (this.opened === null || !keys.includes(this.opened)) this.opened = keys[0] ?? null;
    const focused = document.activeElement?.closest<HTMLElement>(".problem")?.dataset["key"];
    const list = h("ul", { class: "problem-list", "aria-label": "Problems" });
    let shown = false;
    problems.forEach((problem, index) => {
      const key = keys[index] ?? "";
      const open = key === this.opened && !shown;
      if (open) shown = true;
      list.append(this.row(problem, key, open));
    });
    fill(this.element, list);
    if (focused) this.element.querySelector<HTMLElement>(`[data-key="${CSS.escape(focused)}"] .problem-row`)?.focus();
  }

  private row(problem: Problem, key: string, open: boolean): HTMLElement {
    const detail = h("div", { class: "problem-detail", hidden: !open });
    const toggle = h(
      "button",
      { type: "button", class: "problem-row", "aria-expanded": String(open) },
      h("span", { class: `dot ${problem.severity}`, "aria-hidden": "true" }),
      h("span", { class: "unseen" }, problem.severity === "error" ? "Error: " : "Warning: "),
      h("span", { class: "problem-text" }, problem.message),
      h("span", { class: "problem-place" }, this.events.position(problem)),
    );
    toggle.addEventListener("click", () => {
      const now = detail.hidden;
      for (const other of this.element.querySelectorAll<HTMLElement>(".problem")) {
        const mine = other.contains(detail);
        other.querySelector<HTMLElement>(".problem-detail")!.hidden = !(mine && now);
        other.querySelector(".problem-row")?.setAttribute("aria-expanded", String(mine && now));
      }
      this.opened = now ? key : "";
      this.events.go(problem);
    });
    fill(
      detail,
      problem.fixes.length > 0
        ? h(
            "div",
            { class: "fixes" },
            ...problem.fixes.map((fix, index) =>
              h("button", { type: "button", class: "fix", onclick: () => this.events.fix(problem, index) }, icon(icons.bulb) as unknown as Node, fix.title),
            ),
          )
        : null,
      h("pre", { class: "rendered", tabindex: 0, "aria-label": "The whole explanation" }, problem.rendered.trimEnd()),
    );
    return h("li", { class: "problem", "data-key": key }, toggle, detail);
  }
}
