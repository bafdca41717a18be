/* Disable a button of a form, such as *Stop* when nothing runs any more. It would lose the keyboard's focus: that goes
   to the form's first button, which asks again. */
export const disable = (button) => {
  if (document.activeElement === button) button.form.querySelector("button").focus();
  button.disabled = true;
};
