"""Charts by the library's own clast_chart_write (include/clast/chart.h) for the validation pages."""
import ctypes as c
import math

DOUBLES = c.POINTER(c.c_double)
LINE, POINTS = 0, 2


class Series(c.Structure):
    _fields_ = [("kind", c.c_int), ("label", c.c_char_p), ("x", DOUBLES), ("y", DOUBLES), ("low", DOUBLES), ("high", DOUBLES),
                ("value", DOUBLES), ("n", c.c_int64), ("colour", c.c_int32), ("dashed", c.c_bool), ("width", c.c_double)]


class Axis(c.Structure):
    _fields_ = [("label", c.c_char_p), ("log", c.c_bool), ("low", c.c_double), ("high", c.c_double)]


class Note(c.Structure):
    _fields_ = [("x", c.c_double), ("y", c.c_double), ("text", c.c_char_p)]


class Chart(c.Structure):
    _fields_ = [("title", c.c_char_p), ("x", Axis), ("y", Axis), ("value_axis", Axis), ("series", c.POINTER(Series)),
                ("n_series", c.c_int32), ("heat", c.c_void_p), ("mark_y", DOUBLES), ("mark_label", c.POINTER(c.c_char_p)),
                ("n_mark", c.c_int32), ("note", c.POINTER(Note)), ("n_note", c.c_int32), ("equal", c.c_bool),
                ("width", c.c_double), ("height", c.c_double)]


def array(values):
    return (c.c_double * len(values))(*values) if values is not None else None


def points(label, colour, xy, half=None):
    """Points x, y with error bars of these half widths (none: NaN)."""
    x, y = [p[0] for p in xy], [p[1] for p in xy]
    half = half or [math.nan] * len(xy)
    low = [v - (0 if math.isnan(h) else h) for v, h in zip(y, half)]
    high = [v + (0 if math.isnan(h) else h) for v, h in zip(y, half)]
    return POINTS, label, colour, False, (x, y, low, high)


def line(label, colour, xy, dashed=False):
    return LINE, label, colour, dashed, ([p[0] for p in xy], [p[1] for p in xy], None, None)


def draw(library, path, title, x_label, y_label, series, notes=(), x_range=(0.0, 0.0), x_log=False, y_log=False):
    """Writes one chart; the extension tells the format."""
    made = (Series * len(series))(*(
        Series(kind, label.encode() if label else None, *(array(v) for v in data), None, len(data[0]), colour, dashed)
        for kind, label, colour, dashed, data in series))
    words = (Note * max(1, len(notes)))(*(Note(x, y, text.encode()) for x, y, text in notes))
    chart = Chart(title=title.encode(), x=Axis(x_label.encode(), x_log, *x_range), y=Axis(y_label.encode(), y_log, 0.0, 0.0),
                  value_axis=Axis(None, False, 0.0, 0.0), series=made, n_series=len(series), note=words, n_note=len(notes))
    status = c.CDLL(str(library)).clast_chart_write(c.byref(chart), str(path).encode())
    if status != 0:
        raise RuntimeError(f"{path}: clast_chart_write gives {status}")
