"""A drawing as SVG: small, and the same bytes for the same numbers."""
import html

INK, SOFT, LINE, STREET = "#1d2125", "#646b73", "#e3e3df", "#d9dbd7"
HOUSE, STRIP, ALARM = "#cfc9ba", "#c9ccc8", "#c84d00"
SERIES = ("#0072b2", "#d98e00", "#009e73", "#b85c90", "#3fa3dc", "#7a5c2e",
          "#332288", "#999933", "#aa4499", "#117733")
STYLE = ("text{font:12px system-ui,-apple-system,Segoe UI,Helvetica,Arial,"
         f"sans-serif;fill:{SOFT}}}.h{{font-weight:600;fill:{INK}}}"
         ".m{text-anchor:middle}.e{text-anchor:end}"
         ".o{paint-order:stroke;stroke:#fff;stroke-width:3px}"
         "path,line{fill:none;stroke-linecap:round;stroke-linejoin:round}")


def short(x):
    """A number with one decimal at most."""
    text = f"{x:.1f}"
    return text[:-2] if text.endswith(".0") else text


def words(attributes):
    return "".join(f' {key.replace("_", "-")}="{value}"'
                   for key, value in attributes.items() if value is not None)


class Svg:
    """Draws into a page of so many pixels."""

    def __init__(self, width, height):
        self.width, self.height = width, height
        self.parts = []

    def path(self, points, close=False, **attributes):
        """Through the points; of several lists, several lines as one path."""
        lines = points if points and isinstance(points[0], list) else [points]
        text = "".join(self._steps(line) + ("z" if close else "")
                       for line in lines if line)
        if text:
            self.parts.append(f'<path d="{text}"{words(attributes)}/>')

    @staticmethod
    def _steps(line):
        """Relative steps of tenths of a pixel, which add up without drift."""
        at = [(round(10 * x), round(10 * y)) for x, y in line]
        text = f"M{short(at[0][0] / 10)} {short(at[0][1] / 10)}"
        steps = [(x - u, y - v) for (u, v), (x, y) in zip(at, at[1:])]
        moved = [f"{short(x / 10)} {short(y / 10)}" for x, y in steps
                 if (x, y) != (0, 0)]
        return text + ("l" + " ".join(moved) if moved else "h0")

    def line(self, x, y, u, v, **attributes):
        self.path([(x, y), (u, v)], **attributes)

    def circle(self, x, y, radius, **attributes):
        self.parts.append(f'<circle cx="{short(x)}" cy="{short(y)}" '
                          f'r="{short(radius)}"{words(attributes)}/>')

    def rect(self, x, y, width, height, **attributes):
        self.parts.append(f'<rect x="{short(x)}" y="{short(y)}" '
                          f'width="{short(width)}" height="{short(height)}"'
                          f'{words(attributes)}/>')

    def text(self, x, y, what, kind=None, **attributes):
        kind = {"class": kind} if kind else {}
        self.parts.append(f'<text x="{short(x)}" y="{short(y)}"'
                          f'{words(kind | attributes)}>'
                          f"{html.escape(what)}</text>")

    def begin(self, **attributes):
        self.parts.append(f"<g{words(attributes)}>")

    def end(self):
        self.parts.append("</g>")

    def clip(self, name, x, y, width, height):
        """Begins a group of which only this rectangle is to be seen."""
        self.parts.append(f'<clipPath id="{name}"><rect x="{short(x)}" '
                          f'y="{short(y)}" width="{short(width)}" '
                          f'height="{short(height)}"/></clipPath>')
        self.begin(clip_path=f"url(#{name})")

    def __str__(self):
        return (f'<svg xmlns="http://www.w3.org/2000/svg" '
                f'width="{self.width}" height="{self.height}" '
                f'viewBox="0 0 {self.width} {self.height}">\n'
                f"<style>{STYLE}</style>\n"
                f'<rect width="{self.width}" height="{self.height}" rx="6" '
                'fill="#fff"/>\n' + "\n".join(self.parts) + "\n</svg>\n")
