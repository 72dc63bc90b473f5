"use strict";

/** Hands a diagram to the user as a file, with the colours of a light page. */
function save_svg(svg, title) {
  const copy = svg.cloneNode(true);
  copy.setAttribute("style", "color: #1d2329; background: #ffffff");
  const link = document.createElement("a");
  link.href = URL.createObjectURL(new Blob([new XMLSerializer().serializeToString(copy)], {type: "image/svg+xml"}));
  link.download = `${title.toLowerCase().replace(/[^a-z0-9]+/g, "_").slice(0, 60)}.svg`;
  link.click();
  URL.revokeObjectURL(link.href);
}
