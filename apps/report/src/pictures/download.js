// Pictures and tables as files of the reader's.
import { element } from "../element.js";
import { colour } from "../theme.js";

const pixels_per_px = 2; // of a PNG

/// @returns a name that any system takes: of the report, the section, the title.
function file_name(title, button, ending) {
  const section = button.closest("section")?.querySelector("h2")?.textContent;
  const parts = [document.title, section, title].filter((part) => part);
  const whole = parts.join("-").replace(/[^\p{L}\p{N}._-]+/gu, "_");
  return `${whole.replace(/^_+|_+$/g, "") || "picture"}.${ending}`;
}

function save(name, blob) {
  const link = element("a", { href: URL.createObjectURL(blob), download: name });
  link.click();
  setTimeout(() => URL.revokeObjectURL(link.href), 10_000);
}

const svg_text = (shown) => new XMLSerializer().serializeToString(shown);

const svg_blob = (shown) => new Blob([svg_text(shown)], { type: "image/svg+xml" });

/// @returns a promise of the picture's pixels, on the page's ground.
export async function png_blob(shown) {
  const [width, height] = ["width", "height"].map((name) => Number(shown.getAttribute(name)));
  const image = new Image();
  const ready = new Promise((done, failed) => {
    image.onload = done;
    image.onerror = failed;
  });
  image.src = `data:image/svg+xml;charset=utf-8,${encodeURIComponent(svg_text(shown))}`;
  await ready;
  const canvas = element("canvas", {
    width: Math.round(width * pixels_per_px),
    height: Math.round(height * pixels_per_px),
  });
  const context = canvas.getContext("2d");
  context.fillStyle = colour("panel");
  context.fillRect(0, 0, canvas.width, canvas.height);
  context.drawImage(image, 0, 0, canvas.width, canvas.height);
  return new Promise((done) => canvas.toBlob(done, "image/png"));
}

const quoted = (cell) => (/[",\n]/.test(cell) ? `"${cell.replaceAll('"', '""')}"` : cell);

/// @param rows  Lists of texts and numbers; NaN is an empty field.
export const csv_text = (rows) =>
  rows
    .map((row) => row.map((cell) => quoted(Number.isNaN(cell) ? "" : `${cell ?? ""}`)).join(","))
    .join("\n") + "\n";

/// @param title  Of what is saved, a part of the file's name.
/// @param kinds  Functions that make what is asked for: { picture, rows }.
/// @returns small buttons: SVG and PNG of a picture, CSV of rows.
export function downloads(title, { picture, rows }) {
  /// @param make  A blob, or a promise of one.
  const button = (kind, make) => {
    const shown = element(
      "button",
      {
        type: "button",
        title: `Save as ${kind}`,
        "aria-label": `Save ${title || "table"} as ${kind}`,
        click: async () => save(file_name(title, shown, kind.toLowerCase()), await make()),
      },
      kind,
    );
    return shown;
  };
  return element(
    "div.downloads",
    {},
    ...(picture
      ? [
          button("SVG", () => svg_blob(picture())),
          button("PNG", () => png_blob(picture())),
        ]
      : []),
    ...(rows ? [button("CSV", () => new Blob([csv_text(rows())], { type: "text/csv" }))] : []),
  );
}
