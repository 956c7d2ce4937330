// The names that the language knows without being told, read from the same tables as the program's own.

import { readFileSync, readdirSync } from "node:fs";
import { fileURLToPath } from "node:url";

const crate = fileURLToPath(new URL("../../../crates/hray-lang/", import.meta.url));

/** All matches of a pattern's first group in a text. */
const matches = (text, pattern) => [...text.matchAll(pattern)].map((match) => match[1]);

/** The constructors, functions and values of the library, each sorted. */
export function library() {
  const constructors = matches(
    readFileSync(`${crate}src/hry/library/constructors.rs`, "utf8"),
    /Constructor \{\s*name: "(\w+)"/g,
  ).filter((name) => name !== "scene");
  const functions = [];
  const values = [];
  const place = (name, type) => (withoutRecords(type).includes("->") ? functions : values).push(name);
  const natives = readFileSync(`${crate}src/hry/library/natives.rs`, "utf8");
  for (const [, name, type] of natives.matchAll(/^\s+\w+ "(\w+)": "([^"]+)"/gm)) place(name, type);
  for (const file of readdirSync(`${crate}std`).sort()) {
    const text = readFileSync(`${crate}std/${file}`, "utf8");
    for (const [, name, type] of text.matchAll(/^([a-z][\w']*)\s*:((?:.*|\n[ \t]+)*)/gm)) place(name, type);
  }
  const sorted = (names) => [...new Set(names)].sort();
  return { constructors: sorted(constructors), functions: sorted(functions), values: sorted(values) };
}

/** A type without what is in its braces. */
function withoutRecords(type) {
  return type.replace(/\{[^{}]*\}/g, "");
}
