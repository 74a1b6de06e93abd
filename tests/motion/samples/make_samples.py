#!/usr/bin/env python3
"""Writes the samples of record formats beside this script: the first 8 s of the shipped El Centro record, none an original file.

The layouts follow the archives' own descriptions (COSMOS 2001, CSMIP volume 2, ESM's DYNA 1.2, NIED's K-NET ASCII). Layout is
all that the samples prove; their station headers are made up.
"""
import pathlib

HERE = pathlib.Path(__file__).parent
G = 980.665  # [cm/s2]
COUNT, DT = 400, 0.02
NOTE = "Sample made for tests of nsframe from its El Centro 1940 NS record; not a file of any archive"


def shipped():
    lines = (HERE.parents[2] / "examples/motions/el_centro_1940_ns.at2").read_text().splitlines()[4:]
    return [float(word) for line in lines for word in line.split()][:COUNT]


def integral(values):
    sums = [0.0]
    for a, b in zip(values, values[1:]):
        sums.append(sums[-1] + DT * (a + b) / 2)
    return sums


def rows(values, form, each):
    texts = [form % value for value in values]
    return "".join("".join(texts[i:i + each]) + "\n" for i in range(0, len(texts), each))


def cosmos(acceleration):
    text = ""
    for channel, factor in ((1, 1.0), (2, 0.5)):
        a = [factor * value for value in acceleration]
        for quantity, unit, code, values in (("acceleration", "cm/sec2", 4, a), ("velocity", "cm/sec", 5, integral(a))):
            real = [-999.0] * 100
            real[33], real[61], real[62] = DT, 1000 * DT, COUNT * DT
            text += f"Corrected {quantity:<12} (Format v01.20 with 13 text lines)\n{NOTE}\n"
            text += f"Sta Chan {channel:3d}: 180 deg (Rcrdr Chan {channel:2d}) Location: Ground\n" + "\n" * 10
            text += "  20 Integer-header values follow on   2 lines, Format= (10I8)\n" + rows([-999] * 20, "%8d", 10)
            text += " 100 Real-header values follow on  17 lines, Format= (6F13.6)\n" + rows(real, "%13.6f", 6)
            text += f'   1 Comment line(s) follow, each starting with a "|":\n| {NOTE}\n'
            text += f"{COUNT:8d} {quantity} pts, approx    8 secs, units={unit} ({code:02d}),Format=(8F10.5)\n" + rows(values, "%10.5f", 8)
            text += f"End-of-data for Chan {channel:2d} {quantity}\n"
    return text


def csmip(a):
    velocity = integral(a)
    text = f"Corrected accelerogram\n{NOTE}\nChan  1: 180 Deg\n" + "\n" * 22 + rows([0] * 100, "%5d", 16) + rows([0.0] * 100, "%10.3f", 8)
    for name, unit, values in (("accel", "cm/sec2", a), ("veloc", "cm/sec", velocity), ("displ", "cm", integral(velocity))):
        text += f" {COUNT:5d} points of {name} data equally spaced at  .020 sec, in {unit}.    (8f10.3)\n" + rows(values, "%10.3f", 8)
    return text + "/&  ----------  End of data for channel  1  ----------\n"


def esm(a):
    keys = ["EVENT_NAME: EL CENTRO 1940", "EVENT_ID: none", "STATION_CODE: 117", f"STATION_NAME: {NOTE}", "DATE_TIME_FIRST_SAMPLE_YYYYMMDD_HHMMSS: ",
            f"SAMPLING_INTERVAL_S: {DT:.6f}", f"NDATA: {COUNT}", f"DURATION_S: {DT * COUNT:.6f}", "STREAM: HNN", "UNITS: cm/s^2",
            "INSTRUMENT: ", "BASELINE_CORRECTION: BASELINE REMOVED", "HEADER_FORMAT: DYNA 1.2", "DATA_TYPE: ACCELERATION", "USER5: "]
    return "\n".join(keys) + "\n" + "".join(f"{value:.6f}\n" for value in a)


def knet(a):
    top, bottom, offset = 2000, 8388608, 12345
    mean = sum(a) / len(a)
    keys = [("Origin Time", "1940/05/19 04:36:41"), ("Lat.", "0.0"), ("Long.", "0.0"), ("Depth. (km)", "0"), ("Mag.", "6.9"),
            ("Station Code", "SAMPLE"), ("Station Lat.", "0.0"), ("Station Long.", "0.0"), ("Station Height(m)", "0"),
            ("Record Time", "1940/05/19 04:36:56"), ("Sampling Freq(Hz)", f"{1 / DT:.0f}Hz"), ("Duration Time(s)", f"{DT * COUNT:.0f}"),
            ("Dir.", "N-S"), ("Scale Factor", f"{top}(gal)/{bottom}"), ("Max. Acc. (gal)", f"{max(abs(x - mean) for x in a):.3f}"),
            ("Last Correction", "1940/05/19 04:36:56"), ("Memo.", NOTE)]
    counts = [round(value * bottom / top) + offset for value in a]
    return "".join(f"{key:<18}{value}\n" for key, value in keys) + rows(counts, "%9d", 8)


def main():
    g = shipped()
    cm = [G * value for value in g]
    (HERE / "el_centro.V2c").write_text(cosmos(cm))
    (HERE / "el_centro.V2").write_text(csmip(cm))
    (HERE / "el_centro.esm.asc").write_text(esm(cm))
    (HERE / "el_centro.NS").write_text(knet(cm))
    (HERE / "el_centro.csv").write_text(f"# {NOTE}\ntime [s],acceleration [cm/s^2]\n" + "".join(f"{i * DT:.2f},{v:.4f}\n" for i, v in enumerate(cm)))
    (HERE / "el_centro.txt").write_text(f"# {NOTE}\n# unit: g\n" + "".join(f"{v:.5f}\n" for v in g))


main()
