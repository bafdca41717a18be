/* A photo of the printed sheet: its camera, and the photo without the sheet (vmc_lib/marker_sheet.py). A photo is
   { data, width, height }, four bytes a pixel; `sheet` is what Python gives (book/figures/your_photo.py). */
Object.assign(vmcEye, (() => {
  "use strict";

  const { dot, minus, plus, sum, times } = vmcVectors;

  const WINDOW = 5, SHARE = 0.3 / 6; // how far around a corner OpenCV refines it: pixels, of a marker's side

  /* Grey levels, rounded as OpenCV rounds them. */
  const greyLevels = ({ data, width, height }) => {
    const levels = new Uint8Array(width * height);
    for (let i = 0; i < levels.length; i++)
      levels[i] = (4899 * data[4 * i] + 9617 * data[4 * i + 1] + 1868 * data[4 * i + 2] + 8192) >> 14;
    return levels;
  };

  /* The markers { id, corners } that a photo shows, and its camera, of another `size` [width, height]; null where
     the markers are too few. */
  function* readSheet(photo, sheet, size) {
    const { width, height } = photo, levels = greyLevels(photo);
    const markers = yield* vmcEye.findMarkers(levels, width, height, sheet.codes);
    if (markers.length < sheet.fewest) return { markers, camera: null };
    const ids = markers.map(({ id }) => id), refined = markers.map(({ corners }) => {
      const side = sum(corners.map((corner, i) => Math.hypot(...minus(corner, corners[(i + 1) % 4])))) / 4;
      const reach = Math.max(1, Math.min(WINDOW, Math.round(SHARE * side)));
      return corners.map((corner) => vmcEye.refineCorner(levels, width, height, corner, reach));
    });
    const camera = vmcEye.calibrateCamera(ids, refined, width, height, sheet);
    const scale = Math.min(size[0] / width, size[1] / height);
    return { markers, camera: { ...camera, focal: scale * camera.focal, centre: times(0.5, size) } };
  }

  /* The sheet's outline in a camera's picture; what lies behind the camera is cut off (Sutherland & Hodgman). */
  const sheetOutline = (camera, { page, near }) => {
    const depth = page.map((corner) => dot(camera.rotation[2], minus(corner, camera.position)) - near);
    return page.flatMap((corner, k) => {
      const before = (k + page.length - 1) % page.length, share = depth[k] / (depth[k] - depth[before]);
      const cut = plus(corner, times(share, minus(page[before], corner)));
      return [...(depth[before] * depth[k] < 0 ? [cut] : []), ...(depth[k] >= 0 ? [corner] : [])];
    }).map((corner) => vmcEye.project(camera, corner));
  };

  /* Of each row of a picture, the first and last pixel on or within a convex polygon, whose lines are drawn from
     their left ends as OpenCV draws them (Bresenham 1965). */
  const filled = (polygon, height) => {
    const rows = Array.from({ length: height }, () => [Infinity, -Infinity]);
    const corners = polygon.map((corner) => corner.map(Math.round));
    corners.forEach((corner, k) => {
      const [from, to] = [corner, corners[(k + 1) % corners.length]].sort((a, b) => a[0] - b[0]);
      const way = minus(to, from), steps = Math.max(1, ...way.map(Math.abs));
      for (let step = 0; step <= steps; step++) {
        const moved = way.map((side) => Math.sign(side) * Math.ceil((step / steps) * Math.abs(side) - 0.5));
        const [x, y] = plus(from, moved), row = rows[y];
        if (row) rows[y] = [Math.min(row[0], x), Math.max(row[1], x)];
      }
    });
    return rows;
  };
  const grown = (rows, by) => rows.map((_, y) => {
    const near = rows.slice(Math.max(0, y - by), y + by + 1);
    return [Math.min(...near.map(([left]) => left)) - by, Math.max(...near.map(([, right]) => right)) + by];
  });
  const median = (values) => {
    const sorted = Uint8Array.from(values).sort(), half = sorted.length >> 1;
    return Math.floor((sorted[(sorted.length - 1) >> 1] + sorted[half]) / 2);
  };

  /* The photo, painted over within an outline, and a little beyond, in the colour around it. */
  const paintOver = ({ data, width, height }, polygon) => {
    const covered = grown(filled(polygon, height), 4), inside = [], ring = [];
    grown(covered, 7).forEach(([left, right], y) => {
      const [from, to] = covered[y];
      for (let x = Math.max(0, left); x <= Math.min(right, width - 1); x++)
        (x >= from && x <= to ? inside : ring).push(y * width + x);
    });
    const bare = data.slice(), shown = ring.length ? ring : inside;
    for (const c of [0, 1, 2]) {
      const colour = median(shown.map((i) => data[4 * i + c]));
      for (const i of inside) bare[4 * i + c] = colour;
    }
    return { data: bare, width, height };
  };

  return { paintOver, readSheet, sheetOutline };
})());
