// The style sheet of the report, for light and dark screens, phones and paper. Floor 4.
#pragma once

namespace lfdsim {

inline constexpr const char* report_style = R"css(
:root {
  color-scheme: light dark;
  --text: #1c1c1c; --page: #fff; --faint: #5c5c5c; --line: #d4d4d4; --soft: #f5f5f3; --warn: #8a2a00;
}
@media (prefers-color-scheme: dark) {
  :root { --text: #e4e4e2; --page: #171819; --faint: #a2a2a0; --line: #3d3f41; --soft: #212325; --warn: #ff9d6b; }
}
* { box-sizing: border-box; }
html { font: 16px/1.5 system-ui, "DejaVu Sans", sans-serif; color: var(--text); background: var(--page); }
body { max-width: 62rem; margin: 0 auto; padding: 1rem 1rem 4rem; }
h1 { font-size: 1.7rem; line-height: 1.25; margin: 0 0 .3rem; }
h2 { font-size: 1.25rem; margin: 1.4rem 0 .4rem; padding-top: .5rem; border-top: 1px solid var(--line); }
p { margin: .5rem 0; max-width: 46rem; }
a { color: inherit; text-underline-offset: .15em; }
nav ul { margin: .5rem 0; padding: 0; list-style: none; display: flex; flex-wrap: wrap; gap: .1rem 1.4rem; }
.source, .files, .about, figcaption, summary { color: var(--faint); font-size: .875rem; }
.says { font-size: 1.05rem; }
.warning { color: var(--warn); }
.incomplete { border: 2px solid var(--warn); border-radius: .3rem; padding: .6rem 1rem; margin: 1.2rem 0; }
.wide { overflow-x: auto; margin: 1rem 0; }
table { border-collapse: collapse; font-size: .9rem; font-variant-numeric: tabular-nums; }
table.findings { width: 100%; }
caption { text-align: left; color: var(--faint); padding-bottom: .3rem; }
th, td { text-align: left; vertical-align: top; padding: .3rem 1rem .3rem 0; border-bottom: 1px solid var(--line); }
th { font-weight: 400; }
thead th, tr.group th { font-weight: 600; }
tr.group th { padding-top: .9rem; }
td { white-space: nowrap; }
td.remark, table:not(.findings) td { white-space: normal; }
td.remark { color: var(--faint); }
.fold:not([open]) + .folded { display: none; }
section:target > .fold { display: none; }
section:target > .folded { display: block; }
.glance { display: flex; flex-wrap: wrap; gap: .6rem; }
.glance a { flex: 1 1 8rem; max-width: 15rem; text-decoration: none; }
.glance figure { margin: 0; }
.glance img { height: 7rem; width: 100%; object-fit: cover; }
.glance figcaption { overflow: hidden; text-overflow: ellipsis; white-space: nowrap; }
#verdict li, #verdict p { margin: .2rem 0; }
#verdict ul { margin: .2rem 0; padding-left: 1.2rem; }
figure { margin: 1.4rem 0; }
figure img { max-width: 100%; height: auto; display: block; }
figcaption { margin-top: .3rem; max-width: 46rem; }
.drawing > svg { display: block; max-width: 100%; height: auto; color: inherit !important; background: none !important; }
pre {
  background: var(--soft); padding: .8rem 1rem; overflow-x: auto;
  font: .8rem/1.45 ui-monospace, "DejaVu Sans Mono", monospace;
}
@media (max-width: 40rem) {
  .drawing { overflow-x: auto; }
  .drawing > svg { min-width: 34rem; }
  td, th { padding-right: .7rem; }
  #verdict td { white-space: normal; }
}
@media print {
  :root { color-scheme: light; --text: #000; --page: #fff; --faint: #444; --line: #bbb; --soft: #f5f5f3; --warn: #8a2a00; }
  html { font-size: 11px; }
  body { max-width: none; padding: 0; }
  h2, thead { break-after: avoid; }
  figure, tr { break-inside: avoid; }
  pre { white-space: pre-wrap; }
  nav, details { display: none; }
  .fold + .folded { display: block !important; }
}
)css";

}  // namespace lfdsim
