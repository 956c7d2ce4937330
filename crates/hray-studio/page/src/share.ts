// A scene in a link: its text, compressed, in the part of the address that is not sent to a server.

function toBase64(bytes: Uint8Array): string {
  let binary = "";
  for (const byte of bytes) binary += String.fromCharCode(byte);
  return btoa(binary).replaceAll("+", "-").replaceAll("/", "_").replace(/=+$/, "");
}

function fromBase64(text: string): Uint8Array<ArrayBuffer> {
  const binary = atob(text.replaceAll("-", "+").replaceAll("_", "/"));
  const bytes = new Uint8Array(binary.length);
  for (let index = 0; index < binary.length; index++) bytes[index] = binary.charCodeAt(index);
  return bytes;
}

/** The longest text that a link may bring: what a small link can unpack to has to have an end. */
const LONGEST = 4 * 1024 * 1024;

export async function encodeShare(text: string): Promise<string> {
  if (new Blob([text]).size > LONGEST) throw new Error("This text is longer than 4 MiB, which is more than a link may carry. Save it and share the file.");
  const stream = new Blob([text]).stream().pipeThrough(new CompressionStream("deflate-raw"));
  return `#s=${toBase64(new Uint8Array(await new Response(stream).arrayBuffer()))}`;
}

function damaged(): never {
  throw new Error("it is damaged, or not whole");
}

/** The text of a link's fragment; null where it carries none. Throws where it carries one that cannot be read. */
export async function decodeShare(fragment: string): Promise<string | null> {
  if (!fragment.startsWith("#s=")) return null;
  let packed: Uint8Array<ArrayBuffer>;
  try {
    packed = fromBase64(fragment.slice(3));
  } catch {
    damaged();
  }
  const reader = new Blob([packed]).stream().pipeThrough(new DecompressionStream("deflate-raw")).getReader();
  const parts: Uint8Array<ArrayBuffer>[] = [];
  let length = 0;
  for (;;) {
    const { done, value } = await reader.read().catch(() => damaged());
    if (done) break;
    length += value.length;
    if (length > LONGEST) {
      await reader.cancel();
      throw new Error("The scene in this link is longer than 4 MiB.");
    }
    parts.push(value as Uint8Array<ArrayBuffer>);
  }
  try {
    return new TextDecoder("utf-8", { fatal: true }).decode(await new Blob(parts).arrayBuffer());
  } catch {
    damaged();
  }
}
