// The tools: select and drag, draw, brush, erase, pan.

import { along, appended, moved, nearest, within, without } from "../model/cloud.ts";
import type { Host, Place, Tool } from "./tool.ts";

/** Pixels between the points of a brushed stroke, and around an eraser. */
const STEP = 14;
const ERASER = 12;

function hit(host: Host, at: Place): number | null {
  return nearest(host.cloud, at.x, at.y, host.reach * host.pixel);
}

/** Moves the chosen points; with `again` as the same step of the history. */
function drag(host: Host, from: Place, at: Place, again: boolean): Place {
  host.edit(moved(host.cloud, host.chosen, at.x - from.x, at.y - from.y), again);
  return at;
}

class Select implements Tool {
  readonly name = "select";
  readonly title = "Select and drag";
  readonly key = "v";
  readonly says = "Drag a point, or pull a box around several and drag those. Shift adds to the selection.";
  readonly icon = "M5 3l14 8-6 2-2 6z";
  readonly cursor = "default";
  /** Where a box was begun; null while points are dragged. */
  private corner: Place | null = null;
  private again = false;

  down(host: Host, at: Place): void {
    const row = hit(host, at);
    if (row === null) {
      this.corner = at;
      if (!at.shift) host.choose(new Set());
      return;
    }
    if (at.shift) host.choose(new Set([...host.chosen, row]));
    else if (!host.chosen.has(row)) host.choose(new Set([row]));
    this.again = false;
  }

  pull(host: Host, from: Place, at: Place): Place {
    if (this.corner) {
      host.rubber(this.box(this.corner, at));
      return at;
    }
    const again = this.again;
    this.again = true;
    return drag(host, from, at, again);
  }

  up(host: Host, at: Place): void {
    if (this.corner && (at.left !== this.corner.left || at.top !== this.corner.top)) {
      const inside = within(host.cloud, this.box(this.corner, at));
      host.choose(at.shift ? new Set([...host.chosen, ...inside]) : inside);
    }
    host.rubber(null);
    this.corner = null;
  }

  private box(from: Place, to: Place): { left: number; right: number; bottom: number; top: number } {
    return { left: Math.min(from.x, to.x), right: Math.max(from.x, to.x), bottom: Math.min(from.y, to.y), top: Math.max(from.y, to.y) };
  }
}

class Draw implements Tool {
  readonly name = "draw";
  readonly title = "Draw points";
  readonly key = "a";
  readonly says = "Click to add a point; pull to place it.";
  readonly icon = "M12 5v14M5 12h14";
  readonly cursor = "crosshair";

  down(host: Host, at: Place): void {
    host.edit(appended(host.cloud, [at.x, at.y]));
    host.choose(new Set([host.cloud.rows.length - 1]));
  }

  pull(host: Host, from: Place, at: Place): Place {
    return drag(host, from, at, true);
  }

  up(host: Host): void {
    host.choose(new Set());
  }
}

class Brush implements Tool {
  readonly name = "brush";
  readonly title = "Brush a stroke";
  readonly key = "b";
  readonly says = "Pull a stroke: it is sampled as it is drawn.";
  readonly icon = "M4 18c4 0 3-6 8-6s4-6 8-6";
  readonly cursor = "crosshair";

  down(host: Host, at: Place): void {
    host.edit(appended(host.cloud, [at.x, at.y]));
  }

  pull(host: Host, from: Place, at: Place): Place {
    const length = Math.hypot(at.left - from.left, at.top - from.top);
    const count = Math.floor(length / STEP);
    if (!count) return from;
    const added = Array.from({ length: count }, (_, k) => ((k + 1) * STEP) / length).flatMap((t) => [from.x + t * (at.x - from.x), from.y + t * (at.y - from.y)]);
    host.edit(appended(host.cloud, added), true);
    const t = (count * STEP) / length;
    const between = (a: number, b: number): number => a + t * (b - a);
    return { ...at, x: between(from.x, at.x), y: between(from.y, at.y), left: between(from.left, at.left), top: between(from.top, at.top) };
  }
}

class Erase implements Tool {
  readonly name = "erase";
  readonly title = "Erase";
  readonly key = "e";
  readonly says = "Pull over points to delete them.";
  readonly icon = "M8 19h11M5 14l8-9 6 5-8 9H8z";
  readonly cursor = "cell";
  private again = false;

  down(host: Host, at: Place): void {
    this.again = false;
    this.pull(host, at, at);
  }

  pull(host: Host, from: Place, at: Place): Place {
    const touched = along(host.cloud, from, at, ERASER * host.pixel);
    if (touched.size) {
      host.choose(new Set());
      host.edit(without(host.cloud, touched), this.again);
      this.again = true;
    }
    return at;
  }
}

class Pan implements Tool {
  readonly name = "pan";
  readonly title = "Move the picture";
  readonly key = "h";
  readonly says = "Pull the picture; the wheel or two fingers zoom.";
  readonly icon = "M12 3v18M3 12h18M12 3l-3 3M12 3l3 3M12 21l-3-3M12 21l3-3M3 12l3-3M3 12l3 3M21 12l-3-3M21 12l-3 3";
  readonly cursor = "grab";

  pull(host: Host, from: Place, at: Place): Place {
    host.pan(at.left - from.left, at.top - from.top);
    return at;
  }
}

export function makeTools(): Tool[] {
  return [new Select(), new Draw(), new Brush(), new Erase(), new Pan()];
}
