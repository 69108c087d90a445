// What was dropped or chosen: files, and those in folders.

import type { Source } from "./engine";

/** A file by its name, or by its path in a folder. */
export function ofFile(file: File, name = file.webkitRelativePath || file.name): Source {
  return { name, bytes: () => Promise.resolve(file) };
}

/** Files that were chosen, in the order of their names; hidden ones are none that somebody recorded. */
export function ofList(list: Iterable<File>): Source[] {
  return sorted([...list].map((file) => ofFile(file)));
}

function sorted(sources: Source[]): Source[] {
  const shown = sources.filter(({ name }) => !name.split("/").some((part) => part.startsWith(".")));
  return shown.sort((a, b) => a.name.localeCompare(b.name, "en", { numeric: true }));
}

/** Files and folders that were dropped. */
export async function ofDrop(transfer: DataTransfer): Promise<Source[]> {
  // Entries are gone once the event is over.
  const entries = [...transfer.items].map((item) => item.webkitGetAsEntry?.()).filter((entry) => entry !== null && entry !== undefined);
  if (entries.length === 0) return ofList(transfer.files);
  const found: Source[] = [];
  for (const entry of entries) await walk(entry, found);
  return sorted(found);
}

async function walk(entry: FileSystemEntry, found: Source[]): Promise<void> {
  const name = entry.fullPath.replace(/^\//, "");
  if (entry.isFile) {
    const file = () => new Promise<File>((done, failed) => (entry as FileSystemFileEntry).file(done, failed));
    found.push({ name, bytes: file });
    return;
  }
  const reader = (entry as FileSystemDirectoryEntry).createReader();
  // It gives some at a time, and none at the end.
  for (;;) {
    const some = await new Promise<FileSystemEntry[]>((done, failed) => reader.readEntries(done, failed));
    if (some.length === 0) return;
    for (const one of some) await walk(one, found);
  }
}
