// Draws on SVG what is written for a canvas: that part of its interface that
// maps and strips use. In print and in files lines stay lines.
import { picture, svg } from "./svg.js";

const anchors = { left: "start", center: "middle", right: "end", start: "start", end: "end" };
const two = (x) => Number(x.toFixed(2));

export class SvgContext {
  constructor() {
    this.elements = [];
    this.path = "";
    this.dash = [];
    this.moves = ""; // transform
    this.kept = [];
    this.globalAlpha = 1;
    this.lineWidth = 1;
    this.lineJoin = this.lineCap = "round";
    this.fillStyle = this.strokeStyle = "#000";
    this.font = "11px sans-serif";
    this.textAlign = "left";
  }

  /// @returns all that was drawn.
  picture(width, height, title) {
    return picture(width, height, title, ...this.elements);
  }

  add(name, attributes, ...children) {
    this.elements.push(
      svg(
        name,
        {
          ...attributes,
          transform: this.moves || null,
          opacity: this.globalAlpha === 1 ? null : two(this.globalAlpha),
        },
        ...children,
      ),
    );
  }

  save() {
    const { moves, dash, globalAlpha, lineWidth, fillStyle, strokeStyle, textAlign } = this;
    this.kept.push({ moves, dash, globalAlpha, lineWidth, fillStyle, strokeStyle, textAlign });
  }

  restore() {
    Object.assign(this, this.kept.pop());
  }

  translate(x, y) {
    this.moves += ` translate(${two(x)} ${two(y)})`;
  }

  rotate(angle) {
    this.moves += ` rotate(${two((angle * 180) / Math.PI)})`;
  }

  setLineDash(dash) {
    this.dash = dash;
  }

  beginPath() {
    this.path = "";
  }

  moveTo(x, y) {
    this.path += `M${two(x)} ${two(y)}`;
  }

  lineTo(x, y) {
    this.path += `${this.path ? "L" : "M"}${two(x)} ${two(y)}`;
  }

  closePath() {
    this.path += "Z";
  }

  rect(x, y, width, height) {
    this.path += `M${two(x)} ${two(y)}h${two(width)}v${two(height)}h${two(-width)}Z`;
  }

  roundRect(x, y, width, height) {
    this.rect(x, y, width, height);
  }

  /// Of whole circles only.
  arc(x, y, radius) {
    const [left, r, whole] = [two(x - radius), two(radius), two(2 * radius)];
    this.path += `M${left} ${two(y)}a${r} ${r} 0 1 0 ${whole} 0a${r} ${r} 0 1 0 ${-whole} 0Z`;
  }

  /// What is drawn here fits.
  clip() {}

  fill() {
    this.add("path", { d: this.path, fill: this.fillStyle });
  }

  stroke() {
    this.add("path", {
      d: this.path,
      fill: "none",
      stroke: this.strokeStyle,
      "stroke-width": two(this.lineWidth),
      "stroke-linejoin": this.lineJoin,
      "stroke-linecap": this.lineCap,
      "stroke-dasharray": this.dash.length ? this.dash.join(" ") : null,
    });
  }

  fillRect(x, y, width, height) {
    this.beginPath();
    this.rect(x, y, width, height);
    this.fill();
  }

  text(text, x, y, paint) {
    const [, weight, size] = this.font.match(/^(?:(\d+) )?([\d.]+px)/);
    this.add(
      "text",
      {
        x: two(x),
        y: two(y),
        "dominant-baseline": "central",
        "text-anchor": anchors[this.textAlign],
        "font-size": size,
        "font-weight": weight ?? null,
        ...paint,
      },
      text,
    );
  }

  strokeText(text, x, y) {
    this.text(text, x, y, {
      fill: "none",
      stroke: this.strokeStyle,
      "stroke-width": this.lineWidth,
      "stroke-linejoin": "round",
    });
  }

  fillText(text, x, y) {
    this.text(text, x, y, { fill: this.fillStyle });
  }

  measureText(text) {
    return { width: 6.6 * text.length };
  }
}
