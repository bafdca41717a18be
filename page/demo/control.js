/* A demo's control as a place among its values: a slider, a menu, a checkbox, or one of some radio buttons. */

/* How many places it has. */
export const countOf = (input) =>
  input.type === "range" ? +input.max + 1
    : input.type === "checkbox" ? 2
    : input.type === "radio" ? input.closest("fieldset").elements.length
    : input.length;

/* At which place it stands; of radio buttons only the checked one counts. */
export const stands = ({ type, checked, value }) =>
  type === "checkbox" ? +checked : type === "radio" && !checked ? 0 : Math.round(value);

/* Put it at a place, if it has that. */
export const moveTo = (input, place) => {
  if (input.type === "range") input.value = place; // the browser keeps it within the range
  else if (input.type === "checkbox") input.checked = place === 1;
  else if (input.type === "radio") input.checked ||= +input.value === place;
  else if (input.options[place]) input.selectedIndex = place;
};
