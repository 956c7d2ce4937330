// Light, dark, or as the system has it.

export type Theme = "auto" | "light" | "dark";

const order: Theme[] = ["auto", "light", "dark"];

export function currentTheme(): Theme {
  const kept = localStorage.getItem("hray:theme");
  return kept === "light" || kept === "dark" ? kept : "auto";
}

export function applyTheme(theme: Theme): void {
  if (theme === "auto") delete document.documentElement.dataset["theme"];
  else document.documentElement.dataset["theme"] = theme;
  localStorage.setItem("hray:theme", theme);
}

/** The next theme: from what the system has to the other one first, so that one press always shows a change. */
export function nextTheme(theme: Theme): Theme {
  const dark = matchMedia("(prefers-color-scheme: dark)").matches;
  const cycle: Theme[] = dark ? ["auto", "light", "dark"] : ["auto", "dark", "light"];
  return cycle[(cycle.indexOf(theme) + 1) % order.length] ?? "auto";
}
