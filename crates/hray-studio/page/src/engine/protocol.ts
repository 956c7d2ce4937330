// The messages between page and engine, as `hray-session` defines them.
// Offsets into a text are UTF-16 code units from its start; a document is named by its path within the opened folder.

export type Colour = [number, number, number];

export interface ExampleEntry {
  name: string;
  title: string;
  about: string;
  time: boolean;
  picture: string | null;
}

export interface FileEntry {
  path: string;
  kind: "scene" | "classic" | "other";
}

export interface FormatEntry {
  name: string;
  about: string;
  extension: string;
}

export interface Hello {
  version: string;
  root: string;
  files: FileEntry[];
  start: string | null;
  canSave: boolean;
  examples: ExampleEntry[];
  formats: FormatEntry[];
  cores: number;
}

export interface TextEdit {
  from: number;
  to: number;
  text: string;
  /** The file it belongs to, where that is another one. */
  file?: string | null;
}

export interface Fix {
  title: string;
  edits: TextEdit[];
}

export interface Related {
  file: string;
  from: number;
  to: number;
  text: string;
}

export interface Problem {
  file: string;
  from: number;
  to: number;
  severity: "error" | "warning";
  code: string | null;
  message: string;
  /** What is said of the place itself. */
  label?: string;
  related: Related[];
  notes: string[];
  help: string | null;
  rendered: string;
  fixes: Fix[];
  unnecessary?: boolean;
}

/** What `hray info --json` prints; the page reads these fields only. */
export interface Summary {
  width: number;
  height: number;
  max_depth: number;
  samples: number;
  language: string;
  animated: boolean;
  objects: { total: number };
  ambient_lights: number;
  point_lights: number;
  directional_lights?: number;
  spot_lights?: number;
}

/** An expression in a file. */
export interface Place {
  file: string;
  /** From the opened folder. */
  path: string;
  line: number;
  column: number;
  from: number;
  to: number;
  /** The expression on one line. */
  text: string;
}

export interface SceneObject {
  index: number;
  kind: string;
  /** The definition that made it. */
  name: string | null;
  place: Place | null;
  /** The calls that led there, the innermost first. */
  calls: Place[];
}

export interface Surface {
  color: Colour;
  reflection: number;
  transparency: number;
  ior: number;
  highlight: number;
  shine: number;
}

export interface LightShare {
  light: number;
  kind: string;
  place: Place | null;
  reach: "lit" | "everywhere" | "behind" | "outside-cone" | "shadowed";
  shadowed_by: SceneObject | null;
  diffuse: Colour;
  highlight: Colour;
  contribution: Colour;
}

export interface Hit {
  object: SceneObject;
  point: Colour;
  normal: Colour;
  inside: boolean;
  material: Surface;
  lights: LightShare[];
  mirrored: string;
  refracted: string;
  clipped: boolean;
}

/** A ray of the list; its parent stands before it. */
export interface Ray {
  index: number;
  parent: number | null;
  level: number;
  kind: string;
  distance: number | null;
  color: Colour;
  weight: number;
  in_pixel: Colour;
  hit: Hit | null;
}

/** What `hray explain --json` prints. Colours are what the scene computes with. */
export interface Explanation {
  pixel: [number, number];
  color: Colour;
  display: string;
  samples: number;
  seen: { object: SceneObject | null; samples: number }[];
  object: SceneObject | null;
  rays: Ray[];
  omitted: number;
}

export interface CompletionItem {
  label: string;
  kind: string;
  detail?: string | null;
  documentation?: string | null;
  insert?: string | null;
  snippet?: string | null;
}

export interface Definition {
  doc: string | null;
  name: string;
  text: string | null;
  from: number;
  to: number;
}

export interface NumberSpot {
  from: number;
  to: number;
  value: number;
  unit: string;
  step: number;
  min: number | null;
  max: number | null;
}

export interface ColourSpot {
  from: number;
  to: number;
  color: Colour;
}

interface At {
  doc: string;
  version: number;
  at: number;
}

interface Version {
  doc: string;
  version: number;
}

/** Each request: what it takes, what it answers. */
export interface Requests {
  hello: [Record<string, never>, Hello];
  files: [Record<string, never>, { files: FileEntry[] }];
  open: [{ path: string }, { path: string; text: string; disk: string }];
  example: [{ name: string }, { name: string; text: string }];
  edit: [{ doc: string; version: number; text: string }, unknown];
  close: [{ doc: string }, unknown];
  view: [{ doc: string; time: number; width: number | null; height: number | null; overrides: Record<string, string> }, unknown];
  stop: [Record<string, never>, unknown];
  complete: [At, { from: number; to: number; items: CompletionItem[] }];
  hover: [At, null | { from: number; to: number; code: string | null; text: string | null; color: Colour | null }];
  definition: [At, null | Definition];
  rename: [At & { name: string }, { files: { doc: string; edits: TextEdit[] }[] }];
  format: [Version, { text: string }];
  colors: [Version, ColourSpot[]];
  present: [Version & { from: number; to: number; color: Colour }, string[]];
  numbers: [Version, NumberSpot[]];
  explain: [Version & { x: number; y: number; time: number }, Explanation];
  "render-file": [Version & { time: number; format: string }, { name: string; mime: string; bytes: Uint8Array }];
  command: [{ doc: string; time: number; width: number | null; height: number | null }, { command: string }];
  save: [{ doc: string; text: string; disk: string | null }, { disk: string }];
}

export type Events =
  | { event: "problems"; doc: string; version: number; items: Problem[] }
  | { event: "scene"; doc: string; version: number; ok: boolean; summary: Summary | null; animated: boolean; module?: number | null }
  | { event: "frame"; frame: number; doc: string; version: number; time: number; width: number; height: number; passes: number }
  | { event: "progress"; frame: number; pass: number; done: number; seconds: number }
  | { event: "done"; frame: number; seconds: number; rays: number; hash: string | null }
  | { event: "failed"; frame: number; doc: string; message: string }
  | { event: "disk"; path: string; disk: string | null; text: string | null }
  | { event: "files"; files: FileEntry[] }
  | { event: "pixels"; frame: number; x: number; y: number; w: number; h: number; step: number; data: Uint8ClampedArray };

export interface Conflict {
  disk: string | null;
  text: string | null;
}
