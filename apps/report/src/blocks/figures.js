// Figures that stand together, and what is shown of them: all vehicles or one.
import { element } from "../element.js";
import { stations_in } from "./curves.js";
import { figure_block } from "./figure.js";

function vehicle_choice(stations, choose) {
  const choice = element(
    "select",
    { change: () => choose(choice.value === "" ? null : Number(choice.value)) },
    element("option", { value: "" }, "all"),
    ...stations.map((one) => element("option", { value: one }, `${one}`)),
  );
  return element("label.choice", {}, "vehicle ", choice);
}

export function figures_block(blocks) {
  const figures = blocks.map(figure_block);
  const stations = stations_in(blocks);
  return element(
    "div",
    {},
    stations.length > 1
      ? vehicle_choice(stations, (one) => figures.forEach((figure) => figure.of_station(one)))
      : null,
    element("div.figures", {}, ...figures.map(({ shown }) => shown)),
  );
}
