/* Where a browser is told to keep nothing, its storage throws: the theme's scripts get one that lasts as
   long as the page. */
try {
  localStorage.getItem("mode");
} catch {
  const kept = new Map();
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
