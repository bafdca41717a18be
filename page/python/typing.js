/* Type for the reader, so that it can be undone. */
export const type = (area, text) => {
  area.focus();
  if (!document.execCommand("insertText", false, text)) area.setRangeText(text, area.selectionStart, area.selectionEnd, "end");
};

/* Enter indents the next line as Python needs it; Control and Enter check. Tab goes on, as always. */
export const onKey = (event, form) => {
  const area = event.target;
  const before = area.value.slice(0, area.selectionStart).split("\n").pop();
  if (event.key !== "Enter" || event.isComposing) return;
  event.preventDefault();
  if (event.ctrlKey || event.metaKey) form.requestSubmit();
  else type(area, `\n${before.match(/^ */)[0]}${/:\s*(#.*)?$/.test(before) ? "    " : ""}`);
};
