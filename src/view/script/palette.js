// Colours of the page, as it gives them: by name, or as lists.

export const palette = {};

/** Takes the colours of a page. */
export function usePalette(colours) {
  Object.assign(palette, colours);
}
