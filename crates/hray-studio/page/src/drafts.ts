// Typed text that is not saved yet, kept in the browser: synchronously where it fits, so that a page that is closed
// the moment after a key loses nothing; in the browser's database where it is too long for that.

export interface Draft {
  /** The folder that was opened, or the playground. */
  root: string;
  doc: string;
  text: string;
  /** The file's state that the text is based on; null where there was no file. */
  disk: string | null;
  /** When it was typed, in milliseconds. */
  at: number;
  /** The tab that it was typed in. */
  tab: string;
}

const PREFIX = "hray:draft:";

function keyOf(tab: string, root: string, doc: string): string {
  return `${PREFIX}${tab}:${root}:${doc}`;
}

function database(): Promise<IDBDatabase> {
  return new Promise((resolve, reject) => {
    const request = indexedDB.open("hray", 1);
    request.onupgradeneeded = () => request.result.createObjectStore("drafts");
    request.onsuccess = () => resolve(request.result);
    request.onerror = () => reject(request.error ?? new Error("The browser's database cannot be opened."));
  });
}

async function inDatabase<T>(mode: IDBTransactionMode, work: (store: IDBObjectStore) => IDBRequest<T>): Promise<T> {
  const open = await database();
  try {
    return await new Promise((resolve, reject) => {
      const request = work(open.transaction("drafts", mode).objectStore("drafts"));
      request.onsuccess = () => resolve(request.result);
      request.onerror = () => reject(request.error ?? new Error("The browser's database failed."));
    });
  } finally {
    open.close();
  }
}

/** The drafts of this page and of those before it. */
export class Drafts {
  /** Keys whose text went to the database. */
  private long = new Set<string>();

  constructor(
    readonly tab: string,
    readonly failed: (why: string) => void,
  ) {}

  keep(draft: Omit<Draft, "at" | "tab">): void {
    const key = keyOf(this.tab, draft.root, draft.doc);
    const whole: Draft = { ...draft, at: Date.now(), tab: this.tab };
    try {
      localStorage.setItem(key, JSON.stringify(whole));
      if (this.long.delete(key)) void inDatabase("readwrite", (store) => store.delete(key)).catch(() => undefined);
    } catch {
      this.long.add(key);
      localStorage.removeItem(key);
      inDatabase("readwrite", (store) => store.put(whole, key)).catch((error: unknown) => this.failed(String(error)));
    }
  }

  drop(root: string, doc: string, tab = this.tab): void {
    const key = keyOf(tab, root, doc);
    localStorage.removeItem(key);
    this.long.delete(key);
    void inDatabase("readwrite", (store) => store.delete(key)).catch(() => undefined);
  }

  /** All drafts of a folder, the newest first. */
  async all(root: string): Promise<Draft[]> {
    const found: Draft[] = [];
    for (let index = 0; index < localStorage.length; index++) {
      const key = localStorage.key(index);
      if (!key?.startsWith(PREFIX)) continue;
      try {
        found.push(JSON.parse(localStorage.getItem(key) ?? "") as Draft);
      } catch {
        // Not a draft of ours; leave it.
      }
    }
    try {
      found.push(...((await inDatabase("readonly", (store) => store.getAll())) as Draft[]));
    } catch {
      // Without a database there are the short ones.
    }
    return found.filter((draft) => draft.root === root && typeof draft.text === "string").sort((one, other) => other.at - one.at);
  }
}

/** This tab's name: the same after a reload, another in a copy of the tab. */
export async function claimTab(): Promise<string> {
  const before = sessionStorage.getItem("hray:tab");
  const name = before && (await hold(before)) ? before : crypto.randomUUID();
  if (name !== before) {
    await hold(name);
    sessionStorage.removeItem("hray:doc");
  }
  sessionStorage.setItem("hray:tab", name);
  return name;
}

/** Holds a tab's name as long as the page lives; false where another page does. */
function hold(name: string): Promise<boolean> {
  if (!navigator.locks) return Promise.resolve(true);
  return new Promise((resolve) => {
    const patience = new AbortController();
    const timer = setTimeout(() => patience.abort(), 400);
    navigator.locks
      .request(`hray:tab:${name}`, { signal: patience.signal }, () => {
        clearTimeout(timer);
        resolve(true);
        return new Promise(() => undefined);
      })
      .catch(() => resolve(false));
  });
}

/** The tabs that are open now. */
export async function liveTabs(): Promise<Set<string>> {
  if (!navigator.locks) return new Set();
  const { held } = await navigator.locks.query();
  return new Set((held ?? []).map((lock) => lock.name ?? "").filter((name) => name.startsWith("hray:tab:")).map((name) => name.slice(9)));
}
