/* Where a browser is told to keep nothing, its storage throws: the theme's scripts get one that lasts as
   long as the page. Where it is full, what the theme writes lasts as long. */
const kept = new Map();
try {
  localStorage.getItem("mode");
  const { getItem, setItem } = Storage.prototype;
  Storage.prototype.getItem = function (key) { return kept.get(key) ?? getItem.call(this, key); };
  Storage.prototype.setItem = function (key, text) {
    try {
      setItem.call(this, key, text);
      kept.delete(key);
    } catch (error) {
      if (!["mode", "theme"].includes(key)) throw error; // the book's own scripts ask whether there is room
      kept.set(key, text);
    }
  };
} catch {
  const value = {
    getItem: (key) => kept.get(String(key)) ?? null,
    setItem: (key, text) => kept.set(String(key), String(text)),
    removeItem: (key) => kept.delete(String(key)),
    clear: () => kept.clear(),
  };
  document.documentElement.dataset.storage = "page"; // record.js says so
  for (const name of ["localStorage", "sessionStorage"]) Object.defineProperty(self, name, { value });
}

/* The theme does this in the page, where a strict host's policy forbids it. */
for (const name of ["mode", "theme"]) document.documentElement.dataset[name] = localStorage.getItem(name) || "auto";
