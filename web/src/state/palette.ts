/** Colours of objects, sRGB. Written by tools/write_palette.py from knowledge/settings/coloring.toml. */

export const CATEGORIES = [
  "#e69f00",
  "#56b4e9",
  "#009e73",
  "#f0e442",
  "#0072b2",
  "#d55e00",
  "#cc79a7",
  "#760a03",
  "#093e6f",
  "#032ebb",
  "#7c5051",
  "#5285f8",
  "#acb78c",
  "#a9fda8",
  "#2258e5",
  "#a74a04",
  "#6c0c4a",
  "#c22398",
] as const;
export const REST = "#d5d8dc";
export const ANSWER = "#d55e00";
export const CONFIDENCE_BOUNDS = [0.95, 0.8, 0.5, 0.2, 0] as const;
export const CONFIDENCE_COLORS = ["#313695", "#74add1", "#ffffbf", "#f46d43", "#a50026"] as const;
