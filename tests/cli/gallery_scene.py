"""gallery_scene.py SCENE.toml: a scene of burnish-render as the gallery's page takes it: JSON with the contents of files."""
import base64
import json
import pathlib
import sys
import tomllib

scene_file = pathlib.Path(sys.argv[1])
scene = tomllib.loads(scene_file.read_text())
folder = scene_file.parent
files = {}


def take(role, name):
    data = (folder / name).read_bytes()
    files[role] = {"name": name, "base64": base64.b64encode(data).decode()}


(thing,) = scene.pop("object")
image = scene.pop("image")
reflectance, ptm = thing.pop("reflectance", {}), thing.pop("ptm", {})
is_quantized = scene["path"] == "palette"
if scene["path"] == "analytic":  # what normal_map.frag does
    scene["path"] = "normal-map"
if is_quantized:
    take("indexed_map", thing.pop("indexed_map"))
    thing.pop("normal_map", None)
elif "normal_map" in thing and not reflectance.get("textures"):
    take("normal_map", thing.pop("normal_map"))
if "mesh" in thing:
    take("mesh", thing.pop("mesh"))
if "base_color_map" in thing:
    take("base_color", thing.pop("base_color_map"))
if "direction_map" in reflectance and not reflectance.get("textures"):
    take("direction_map", reflectance["direction_map"])
for which in "tbn" if "textures" in reflectance else "":
    (name,) = [p.name for p in folder.glob(f"{reflectance['textures']}_{which}.*")]
    take(which, name)
for role, name in scene.pop("tables", {}).items():
    take(role, name)
if ptm.get("map", "").endswith("/"):
    for colour in "red", "green", "blue":
        take(f"abc_{colour}", f"{ptm['map']}abc_{colour}.png")
        take(f"def_{colour}", f"{ptm['map']}def_{colour}.png")
    take("ptm", f"{ptm['map']}ptm.json")
elif ptm:
    take("map", ptm["map"])
scene["lights"] = scene.pop("light")
for light in scene["lights"]:
    light["color"] = [c * light.get("intensity", 1) for c in light.get("color", [1, 1, 1])]
material = scene.get("material") or [{k: reflectance[k] for k in ("diffuse", "specular", "ambient") if k in reflectance}]
scene.update(object=thing, files=files, background=image.get("background", [0, 0, 0]),
             material=material if is_quantized else material[0], width=image["width"], height=image["height"])
json.dump(scene, sys.stdout)
