// Makes elements.

/// @param what        Name of the element and its classes: "div.a.b".
/// @param attributes  Functions become listeners; null and false are left out.
/// @param children    Elements or texts.
export function element(what, attributes = {}, ...children) {
  const [name, ...classes] = what.split(".");
  const made = document.createElement(name);
  if (classes.length) made.className = classes.join(" ");
  for (const [key, value] of Object.entries(attributes)) {
    if (typeof value === "function") made.addEventListener(key, value);
    else if (value === true) made.setAttribute(key, "");
    else if (value !== null && value !== false) made.setAttribute(key, value);
  }
  made.append(...children.filter((child) => child !== null));
  return made;
}

/// @returns elements for a text in which `code` stands between backquotes.
export function marked_up(text) {
  return text
    .split("`")
    .map((part, i) => (i % 2 ? element("code", {}, part) : part));
}
