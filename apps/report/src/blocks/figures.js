// Figures that stand together, and what is shown of them: all vehicles or one.
import { element } from "../element.js";
import { hook } from "../hook.js";
import { stations_in } from "./curves.js";
import { figure_block } from "./figure.js";

/// @param one_only  Whether all at once cannot be shown; then it is the vehicle
///                  that the reader looks at on the map, too.
function vehicle_choice(stations, one_only, choose) {
  const choice = element(
    "select",
    { change: () => choose(choice.value === "" ? null : Number(choice.value)) },
    ...(one_only ? [] : [element("option", { value: "" }, "all")]),
    ...stations.map((one) => element("option", { value: one }, `${one}`)),
  );
  if (one_only)
    hook.players.at(-1)?.on_look((station) => {
      if (!stations.includes(station)) return;
      choice.value = station;
      choose(station);
    });
  return element("label.choice", {}, "vehicle ", choice);
}

export function figures_block(blocks) {
  const figures = blocks.map(figure_block);
  const stations = stations_in(blocks);
  const one_only = blocks.some(({ strips }) => strips);
  const choose = (one) => figures.forEach((figure) => figure.of_station(one));
  if (one_only) choose(stations[0]);
  return element(
    "div",
    {},
    stations.length > 1
      ? vehicle_choice(stations, one_only, choose)
      : null,
    element("div.figures", {}, ...figures.map(({ shown }) => shown)),
  );
}
