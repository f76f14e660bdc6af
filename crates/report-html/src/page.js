// The script of the page: draws plots, sorts the summary table, slides between images.
// Every part of the page that is not there is skipped.
(() => {
  "use strict";

  // --- plots -------------------------------------------------------------------------------------------

  const source = document.getElementById("plots");
  const plots = source ? JSON.parse(source.textContent) : [];
  // Pixels of CSS: as wide as A4 and letter allow, and three plots a page; bars keep their height.
  const PRINTED_WIDTH = 690;
  const PRINTED_HEIGHT = 270;

  // The page's colours, which depend on dark mode and on print.
  const colour = (name) => getComputedStyle(document.documentElement).getPropertyValue(`--${name}`).trim();

  // A layout with what all plots share; the plot's own words win.
  const layoutOf = (plot, printed) => {
    const [text, grid, line] = printed
      ? ["#1b1f24", "#d8dde2", "#8c959f"]
      : [colour("text"), colour("grid"), colour("line")];
    const axis = (own) => ({
      gridcolor: grid, linecolor: line, zerolinecolor: line, tickcolor: line,
      // Marks outside of the plot, between the labels of a logarithmic axis too.
      ticks: "outside", ticklen: 5, showline: true,
      ...(own.type === "log" ? { minor: { ticks: "outside", ticklen: 3, tickcolor: line, showgrid: false } } : {}),
      ...own,
      title: { standoff: 8, ...own.title },
    });
    return {
      paper_bgcolor: "rgba(0,0,0,0)",
      plot_bgcolor: "rgba(0,0,0,0)",
      font: { color: text, size: 12, family: "system-ui, sans-serif" },
      margin: { l: 8, r: 12, t: 8, b: 8 },
      legend: { orientation: "h", x: 0, y: 1.02, xanchor: "left", yanchor: "bottom", traceorder: "normal" },
      modebar: { bgcolor: "rgba(0,0,0,0)", color: line, activecolor: text, orientation: "v" },
      hoverlabel: { align: "left" },
      showlegend: true,
      dragmode: false, // a finger scrolls the page
      ...plot.layout,
      xaxis: axis(plot.layout.xaxis),
      yaxis: axis(plot.layout.yaxis),
      ...(printed
        ? { width: PRINTED_WIDTH, height: plot.layout.barmode ? undefined : PRINTED_HEIGHT, autosize: false }
        : { autosize: true }),
    };
  };

  const tracesOf = (plot, printed) => plot.data.map((trace) => {
    if (trace.meta !== "text-colour") return trace;
    const text = printed ? "#1b1f24" : colour("text");
    const marker = { ...trace.marker, color: text, line: { ...trace.marker.line, color: text } };
    return { ...trace, marker };
  });

  const draw = (printed) => {
    for (const plot of plots) {
      const settings = {
        responsive: !printed,
        displaylogo: false,
        displayModeBar: "hover",
        modeBarButtonsToRemove: ["select2d", "lasso2d", "autoScale2d"],
      };
      Plotly.react(plot.id, tracesOf(plot, printed), layoutOf(plot, printed), settings);
    }
  };
  draw(false);
  matchMedia("(prefers-color-scheme: dark)").addEventListener("change", () => draw(false));
  addEventListener("beforeprint", () => draw(true));
  addEventListener("afterprint", () => draw(false));

  // --- table -------------------------------------------------------------------------------------------

  // Numbers stand in data-value; what was not measured has null and stays at the end.
  const keyOf = (cell) => {
    if (cell.dataset.value !== undefined) return Number(cell.dataset.value);
    return cell.querySelector(".absent") ? null : cell.textContent;
  };
  const order = (a, b, direction) => {
    if (a === null || b === null) return (a === null) - (b === null);
    return direction * (typeof a === "number" ? a - b : a.localeCompare(b));
  };
  const sortable = (table) => {
    const body = table.tBodies[0];
    const headings = [...table.tHead.rows[0].cells];
    headings.forEach((heading, column) => {
      const button = document.createElement("button");
      button.type = "button";
      button.textContent = heading.textContent;
      heading.replaceChildren(button);
      button.addEventListener("click", () => {
        const ascending = heading.getAttribute("aria-sort") !== "ascending";
        for (const other of headings) other.removeAttribute("aria-sort");
        heading.setAttribute("aria-sort", ascending ? "ascending" : "descending");
        const rows = [...body.rows].map((row) => [keyOf(row.cells[column]), row]);
        rows.sort((a, b) => order(a[0], b[0], ascending ? 1 : -1));
        body.append(...rows.map(([, row]) => row));
      });
    });
  };
  document.querySelectorAll("table.sortable").forEach(sortable);

  // --- images ------------------------------------------------------------------------------------------

  const viewer = document.getElementById("viewer");
  if (viewer) {
    const part = (name) => document.getElementById(`viewer-${name}`);
    const show = (choice, image) => {
      const chosen = document.getElementById(choice.value);
      image.src = chosen.src;
      image.alt = chosen.alt;
    };
    const update = () => {
      show(part("left"), part("over"));
      show(part("right"), part("under"));
      viewer.style.setProperty("--split", `${part("split").value}%`);
    };
    for (const name of ["left", "right", "split"]) part(name).addEventListener("input", update);
    update();
  }
})();
