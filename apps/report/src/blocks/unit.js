// The unit of a figure, as its axis has it.
/// @param label  Of an axis: "latency, ms".
/// @returns its unit behind a space: " ms"; nothing where there is none.
export function unit_of(label) {
  const unit = label.slice(label.lastIndexOf(",") + 1).trim();
  const is_unit = label.includes(",") && unit !== "F" && !unit.includes(" ");
  return is_unit ? ` ${unit}` : "";
}
