// Colors, of Okabe and Ito's palette for all eyes; what differs in meaning differs in width, dash or shape, too.

export interface Palette {
  readonly paper: string;
  readonly ink: string;
  readonly faint: string;
  readonly curve: string;
  readonly triangulation: string;
  readonly voronoi: string;
  readonly axis: string;
  readonly size: string;
  readonly weak: string;
  readonly missing: string;
  readonly extra: string;
  readonly smooth: string;
  readonly proof: string;
  readonly chosen: string;
}

export const LIGHT: Palette = {
  paper: "#ffffff", ink: "#1b1f24", faint: "#6b737c",
  curve: "#0072b2", triangulation: "#b9bfc6", voronoi: "#7fb5a0", axis: "#b0558c", size: "#e69f00",
  weak: "#d55e00", missing: "#d55e00", extra: "#009e73", smooth: "#b0558c", proof: "#009e73", chosen: "#d55e00",
};

export const DARK: Palette = {
  paper: "#14171b", ink: "#eef1f4", faint: "#9aa4ae",
  curve: "#56b4e9", triangulation: "#4b535c", voronoi: "#3f8f74", axis: "#e49cc7", size: "#e6b13c",
  weak: "#ff8a3d", missing: "#ff8a3d", extra: "#2fd0a0", smooth: "#e49cc7", proof: "#2fd0a0", chosen: "#ff8a3d",
};
