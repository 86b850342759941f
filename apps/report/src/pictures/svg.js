// Makes SVG elements.

const space = "http://www.w3.org/2000/svg";

/// @param attributes  null is left out.
export function svg(name, attributes = {}, ...children) {
  const made = document.createElementNS(space, name);
  for (const [key, value] of Object.entries(attributes))
    if (value !== null) made.setAttribute(key, value);
  made.append(...children);
  return made;
}

/// @returns the root of a picture of that many CSS pixels, which scales with
/// the room it gets.
export const picture = (width, height, title, ...children) =>
  svg(
    "svg",
    {
      xmlns: space,
      width,
      height,
      viewBox: `0 0 ${width} ${height}`,
      role: "img",
      "aria-label": title,
      "font-family": "system-ui, -apple-system, Segoe UI, Roboto, sans-serif",
    },
    ...children,
  );

const looks = [
  "fill",
  "stroke",
  "stroke-width",
  "stroke-linejoin",
  "stroke-dasharray",
  "paint-order",
  "opacity",
  "font-size",
];

/// @returns a copy of a picture on the page that looks the same without the
/// page's style.
export function standalone(shown) {
  const copy = shown.cloneNode(true);
  copy.setAttribute("xmlns", space);
  const originals = [shown, ...shown.querySelectorAll("*")];
  [copy, ...copy.querySelectorAll("*")].forEach((one, i) => {
    const style = getComputedStyle(originals[i]);
    for (const look of looks) one.setAttribute(look, style.getPropertyValue(look));
  });
  copy.setAttribute("font-family", "system-ui, sans-serif");
  return copy;
}
