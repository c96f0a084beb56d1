// Elements of the page. Data are put into the page only as text and properties, never as markup.

export const byId = (id) => document.getElementById(id);

/// An element with properties; those with a dash are attributes.
export function make(tag, properties = {}, ...children) {
  const element = document.createElement(tag);
  for (const [name, value] of Object.entries(properties))
    if (name.includes("-") || name === "role" || name === "for") element.setAttribute(name, value);
    else element[name] = value;
  element.append(...children);
  return element;
}

/// Sets a text only where it differs, so that a screen reader reads it once.
export function say(element, text) {
  if (element.textContent !== text) element.textContent = text;
}

export function download(name, parts, type) {
  const address = URL.createObjectURL(new Blob(parts, { type }));
  make("a", { href: address, download: name }).click();
  setTimeout(() => URL.revokeObjectURL(address), 60000);
}

/// Up to `digits` significant digits, without trailing zeros.
export const short = (number, digits = 6) => String(Number(Number(number).toPrecision(digits)));
export const clamp = (x, low, high) => Math.min(Math.max(x, low), high);
export const finite = (...numbers) => numbers.every(Number.isFinite);
