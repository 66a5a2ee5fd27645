"""Runs glassbrick, and reads what it reports."""
import json
import os
import subprocess


def write_transfer_function(path, points):
    with open(path, "w") as file:
        json.dump({"points": [{"value": v, "color": c, "opacity": a} for v, c, a in points], "unit": 1.0}, file)


def render(binary, volume, picture, points, mode, shaded, size, repeat, folder, options=()):
    """The report of a picture drawn `repeat` times. Raises subprocess.CalledProcessError."""
    function, report = os.path.join(folder, "tf.json"), os.path.join(folder, "report.json")
    write_transfer_function(function, points)
    shading = ["--shading", "phong"] if shaded else []
    subprocess.run([binary, "render", volume, "-o", picture, "--tf", function, "--mode", mode, *shading,
                    "--size", f"{size}x{size}", "--repeat", str(repeat), "--report", report, *map(str, options)],
                   check=True, capture_output=True, text=True)
    with open(report) as file:
        return json.load(file)
