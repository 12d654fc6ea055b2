# SPDX-FileCopyrightText: The gloam authors
# SPDX-License-Identifier: MIT
"""Fails on an include that the architecture does not allow. usage: include_arrows.py ROOT

An owner is a layer (engine/ecs), a module (modules/lights), the sandbox or the tests; shaders/<name> belongs to the layer or
module of that name."""
import re
import sys
from pathlib import Path

import module_graph
import source_text

# The layers that each one may include directly; closed transitively below. The graph of modules: module_graph.py.
LAYERS = {
    "core": (), "math": ("core",), "jobs": ("core",), "ecs": ("core", "jobs"), "schedule": ("ecs", "jobs"),
    "gpu": ("core", "math", "jobs"), "frame": ("gpu",), "scene": ("ecs", "schedule", "math"),
    "render": ("schedule", "frame", "scene"),
}
# Separate projects, which see our headers as installed and their own headers by their names.
HOSTS = ("tests/embedding/host/", "tests/embedding/host_cpu/", "tests/embedding/host_ecs/")
MODULE_LIST = module_graph.LIST  # knows every module and its checks of kernels; no module may include it
ABOVE_MODULES = module_graph.ABOVE  # may include the public headers of every module
KERNEL_CHECKS = ["reference", "kernel_checks.h"]
# The headers of a module that others may include; a few modules have more.
MODULE_PUBLIC = ("components.h", "module.h", "outputs.h")
MODULE_PUBLIC_TOO = {"lights": ("light_names.h",), "lighting": ("occlusion.h",), "particles": ("bake.h", "baked_light.h"), "reflections": ("bake.h", "captures.h"),
                     "shadows": ("reference.h",), "accuracy": ("stability.h", "picture_difference.h")}

# The rooms of modules that are also a target <module>_cpu, for hosts without a GPU, and the files directly in the folder that
# belong to it. They include one another along the arrows of modules, the layers below, and nothing else.
CPU_ROOMS = {
    "lights": (("bins", "masks", "selection"), ("components", "cpu_clones")), "closeups": (("umbra",), ("components",)),
    "reflections": (("culling",), ("components",)), "grass": (("growth",), ("components",)),
}
CPU_LAYERS = ("core", "math", "jobs", "ecs")

# Folders with rooms: the rooms in the order in which data flows through them, and the headers directly in the folder
# that rooms may include. A room may include itself and earlier rooms. Other files directly in the folder may include
# any room.
ROOMS = {
    "modules/lights": (("bins", "masks", "selection", "lists", "debug"), ("components", "outputs", "knobs", "cpu_clones", "light_names", "light_set")),
    "modules/shadows": (("views", "atlas", "maps", "filter", "final_lists", "reference", "debug"),
                        ("components", "outputs", "knobs", "reference")),
    "modules/closeups": (("umbra", "pairs", "compose", "debug"), ("components", "knobs")),
    "modules/lighting": (("antialiasing", "display", "reference"), ("components", "outputs", "knobs", "environment", "lighting_passes")),
    "modules/reflections": (("culling", "relighting", "proxies", "planar", "probes", "passes", "fitting", "bake", "diffuse", "recapture", "reference", "debug"),
                            ("components", "captures", "bake", "override", "knobs", "frame", "bindings", "materials", "scene_unit")),
    "modules/grass": (("growth", "field", "lod", "simulation", "drawing", "reference", "debug"), ("components", "knobs", "frame")),
    "modules/particles": (("emitters", "bake", "simulation", "sorting", "lighting", "drawing", "reference", "debug"),
                          ("components", "baked_light", "bake", "knobs", "frame")),
    "modules/depth_of_field": (("lens", "levels", "tiles", "sprites", "blur", "compose", "reference", "debug"), ("components", "knobs", "frame", "dof_passes")),
    "modules/glare": (("reference",), ("components", "knobs", "levels", "view_glare", "glare_passes")),
    "shaders/render": (("sort", "culling", "gbuffer", "kernel_check"), None),
    "shaders/lights": (("lists", "debug"), None),
    "shaders/lighting": (("opaque", "blended", "antialiasing", "display", "kernel_check"), None),
    "shaders/depth_of_field": (("tiles", "sprites", "blur", "compose", "debug"), None),
    "engine/core": (("system", "storage", "text"), None),
    "engine/jobs": (("pool", "conformance"), ("executor", "first_failure", "job_graph", "executor_conformance")),
    "engine/ecs": (("storage",), ("component", "entity")),
    "engine/gpu": (("spirv", "vulkan", "recording"), None),
    "engine/gpu/vulkan": (("startup", "resources", "compile", "binding", "submission"), ("api", "barriers", "convert", "errors")),
    "engine/frame": (("planning", "transfers"), ("declaration", "frame_graph")),
    "engine/scene": (("decoding", "keys", "assets", "gltf", "posing"),
                     ("assets", "components", "resources", "scene_path", "transforms", "units")),
    "engine/scene/gltf": (("parsing", "validation", "buffers", "assets", "entities"), ("document", "place")),
    "engine/render": (("knobs", "governor", "kept_frames", "camera", "pipelines", "packing", "uploads", "scene", "draws", "declare", "resources", "sort",
                       "passes", "readback", "reference", "kernel_check", "worlds", "modules_in_use", "views", "report", "frame", "redraw"),
                      ("view", "outputs", "frame_builder", "settled_result", "host_geometry", "module", "view_request", "frame_report",
                       "renderer_options", "board")),
    "sandbox/output": (("pictures",), ("file_io", "json_text")),
    "sandbox/scenes": (("construction", "street", "dusk", "lamps", "meadow", "wet_street"), ()),
    "sandbox/session": (("loading", "baking", "drawing", "results"), ("program_knobs", "session")),
    "sandbox/play": (("input", "display", "budget", "wipe", "start"), ()),
    "sandbox/bench": (("harness", "ecs", "jobs", "frame", "governor", "lights", "shadows", "closeups", "reflections", "grass",
                       "particles", "dof", "glare", "papers"), ()),
    "sandbox": (("output", "scenes", "session", "sweep", "window", "play", "bench", "selftest", "commands"), ("options", "console", "log")),
    "shaders/shadows": (("maps", "filter", "final_lists", "debug"), None),
    "shaders/grass": (("lod", "simulation", "drawing", "debug"), None),
    "shaders/particles": (("simulation", "sorting", "lighting", "drawing", "debug"), None),
    "shaders/reflections": (("culling", "proxies", "probes", "passes", "recapture", "debug", "kernel_check"), None),
}

# Third-party headers: the folders that may include them, and those that a public header may not include.
HEAVY = (
    (re.compile(r"^(vulkan/|volk\.h$|vk_mem_alloc\.h$)"), ("engine/gpu/", "tests/gpu/", "tests/embedding/"), "Vulkan's headers"),
    (re.compile(r"^(GLFW/|imgui|CLI/|spdlog/)"), ("sandbox/", "tests/"), "the sandbox's libraries"),
    (re.compile(r"^(tiny_gltf|stb_|OpenMesh/)"), ("engine/scene/", "tests/", "sandbox/"), "the importer's libraries"),
    (re.compile(r"^embree"), ("modules/", "tests/", "sandbox/"), "Embree"),
)
NOT_IN_PUBLIC_HEADERS = re.compile(r"^(vulkan/|volk\.h$|GLFW/|imgui|tiny_gltf|stb_|OpenMesh/|nlohmann/|embree)")

INCLUDE = re.compile(r'^[ \t]*#[ \t]*include[ \t]*(?:"([^"\n]+)"|<([^>\n]+)>)', re.MULTILINE)


LAYER_REACH = module_graph.closure(LAYERS)
MODULE_REACH = {}  # of the tree that check() checks


def includes(text):
    """(line, path, quoted) for each include."""
    clean = source_text.without_comments(text)
    return [(clean.count("\n", 0, m.start()) + 1, m.group(1) or m.group(2), m.group(1) is not None)
            for m in INCLUDE.finditer(clean)]


def is_public_header(name):
    parts = name.split("/")
    if not name.endswith(".h") or parts[0] not in ("engine", "modules"):
        return False
    return parts[0] == "engine" or parts[1] == MODULE_LIST or (
        len(parts) == 3 and parts[-1] in (*MODULE_PUBLIC, *MODULE_PUBLIC_TOO.get(parts[1], ())))


def is_cpu_file(parts):
    """Whether a file belongs to the target <module>_cpu."""
    rooms, base = CPU_ROOMS.get(parts[1], ((), ())) if parts[0] == "modules" else ((), ())
    return parts[2] in rooms if len(parts) > 3 else len(parts) == 3 and parts[2].partition(".")[0] in base


def is_installed_header(name):
    parts = name.split("/")
    return is_public_header(name) or (name.endswith(".h") and len(parts) > 3 and is_cpu_file(parts))


def cpu_fault(parts, target):
    """The reason why a file of a CPU target may not include a project path, or None."""
    if not is_cpu_file(parts) or is_cpu_file(target) or (target[0] == "shaders" and target[-1] != "shaders.h"):
        return None
    if target[0] == "engine" and len(target) > 2 and target[1] in CPU_LAYERS:
        return None
    return f"{parts[1]}_cpu stands on {', '.join(CPU_LAYERS)} and CPU rooms only"


def cpp_arrow(parts, target):
    """The reason why a C++ file may not include a project path, or None."""
    kind = parts[0]
    own = parts[1] if len(parts) > 2 else ""
    if kind == "tests" or (kind == "sandbox" and own == "bench"):
        return None
    to_own = target[1] if len(target) > 2 else ""
    if target[0] == "engine":
        if kind != "engine" or to_own == own or to_own in LAYER_REACH[own]:
            return None
        return f"engine/{own} does not stand on engine/{to_own}"
    if target[0] == "modules":
        if kind == "engine":
            return "the engine knows no module"
        if to_own == own:
            return None
        if own == MODULE_LIST and target[2:] == KERNEL_CHECKS:
            return None
        if kind == "modules" and own not in ABOVE_MODULES and to_own not in MODULE_REACH[own]:
            return f"modules/{own} does not stand on modules/{to_own}"
        return None if is_public_header("/".join(target)) else f"of another module only {', '.join(MODULE_PUBLIC)}"
    if target[0] == "shaders":
        if to_own == "common" and target[-1].endswith(".h"):
            return None
        # The generated list of all embedded shaders, for the sandbox's reload.
        if kind == "sandbox" and to_own == "every":
            return None
        own_shaders = "sandbox" if kind == "sandbox" else own
        if to_own != own_shaders:
            return "C++ includes only its own shaders folder and shaders/common"
        generated = target[-1] == "shaders.h" or target[-1].endswith(".spv.h")
        return None if generated or target[-1].endswith("_shared.h") else "of shaders C++ includes *_shared.h only"
    if target[0] == "sandbox":
        return None if kind == "sandbox" else "nothing stands on the sandbox"
    return "only tests include tests/"


def shader_arrow(parts, target):
    """The reason why a file below shaders/ may not include a project path, or None."""
    if target[0] != "shaders" or len(target) < 3:
        return "shaders include shaders only"
    own, to_own, leaf = parts[1], target[1], target[-1]
    if to_own in ("common", own):
        return None
    if own == "common":
        return "shaders/common stands on nothing"
    if own == "sandbox":
        return None if leaf.endswith(("_api.glsl", "_shared.h")) else "only *_api.glsl and *_shared.h"
    below = LAYER_REACH[own] if own in LAYERS else set(LAYERS) | MODULE_REACH[own]
    if to_own not in below:
        return f"shaders/{own} does not stand on shaders/{to_own}"
    if leaf.endswith("_api.glsl") or (to_own in LAYERS and leaf.endswith("_shared.h")):
        return None
    return "of another folder's shaders only *_api.glsl"


def exists(root, include):
    generated = re.fullmatch(r"shaders/\w+/(shaders\.h|(\w+/)?[\w.]+\.spv\.h)|tests/render/shared_structs_table\.h", include)
    return bool(generated) or (root / include).is_file()


def third_party_fault(name, include):
    for pattern, places, what in HEAVY:
        if pattern.search(include) and not name.startswith(places):
            return f"<{include}>: {what} stay in {', '.join(p.rstrip('/') for p in places)}"
    if is_installed_header(name) and NOT_IN_PUBLIC_HEADERS.search(include):
        # Exceptions: headers of engine/gpu that include Vulkan and are not installed, and the header for hosts with a
        # VkDevice.
        if not re.fullmatch(r"engine/gpu/vulkan/.*|engine/gpu/vulkan_interop\.h|engine/gpu/.*_internal\.h|engine/gpu/vk_.*\.h", name):
            return f"<{include}>: public headers carry no such header"
    return None


def owner_fault(parts):
    known = {"engine": LAYERS, "modules": (*MODULE_REACH, *ABOVE_MODULES)}
    if parts[0] in known and len(parts) > 2 and parts[1] not in known[parts[0]]:
        return f"{parts[0]}/{parts[1]} is not in the architecture"
    if parts[0] == "shaders":
        owners = ("common", "sandbox", *LAYERS, *MODULE_REACH)
        if len(parts) not in (3, 4) or parts[1] not in owners:
            return "a shader stands in shaders/common, or in the folder of a layer, a module or the sandbox"
    return None


def room_of(folder, parts):
    """The room of a path inside a folder with rooms; "" for a file directly in the folder, None for a path elsewhere."""
    depth = folder.count("/") + 1
    if "/".join(parts[:depth]) != folder:
        return None
    return parts[depth] if len(parts) > depth + 1 else ""


def room_fault(parts, target):
    """The reason why a file in one room may not include another file of the same folder, or None."""
    for folder, (rooms, base) in ROOMS.items():
        room, to_room = room_of(folder, parts), room_of(folder, target)
        if not room or to_room is None:
            continue
        if to_room == "":
            if base is not None and target[-1].partition(".")[0] not in base:
                return f"{folder}/{room} does not stand on {folder}/{target[-1]}"
        elif room not in rooms or to_room not in rooms:
            return f"{folder} has no such room"
        elif rooms.index(to_room) > rooms.index(room):
            return f"{folder}/{room} does not stand on {folder}/{to_room}"
    return None


def check_file(root, name):
    parts = name.split("/")
    fault = owner_fault(parts)
    if fault:
        return [f"{name}: {fault}"]
    faults = []
    found = includes(source_text.read(root, name))
    if name.startswith(HOSTS):
        def of_host(include):
            return next((host + include for host in (str(Path(name).parent) + "/", *HOSTS) if (root / host / include).is_file()), include)
        found = [(line, of_host(include) if quoted else include, quoted) for line, include, quoted in found]
    own_header = re.sub(r"\.cpp$", ".h", name)
    if name.endswith(".cpp") and (root / own_header).is_file() and (not found or found[0][1] != own_header):
        faults.append(f"{name}: its own header comes first")
    for line, include, quoted in found:
        target = include.split("/")
        ours = target[0] in source_text.SOURCE_FOLDERS
        fault = None
        if parts[0] == "shaders":
            fault = None if not quoted and name.endswith(".h") else shader_arrow(parts, target)
        elif ours:
            fault = cpp_arrow(parts, target)
            fault = fault or cpu_fault(parts, target)
            if fault is None and is_installed_header(name) and target[0] == "modules" and not is_installed_header(include):
                fault = "a public header includes public headers only"
        else:
            fault = third_party_fault(name, include)
        if fault is None and ours:
            fault = room_fault(parts, target)
        if fault is None and quoted and not ours:
            fault = "a project include is the full path from the root; others stand in <>"
        if fault is None and ours and not exists(root, include):
            fault = "there is no such file"
        if fault:
            faults.append(f"{name}:{line}: {include}: {fault}")
    return faults


def check(root):
    root = Path(root)
    MODULE_REACH.clear()
    MODULE_REACH.update(module_graph.closure(module_graph.read(root)))
    names = source_text.files(root, (".h", ".cpp", ".glsl"))
    return [fault for name in names for fault in check_file(root, name)], len(names)


if __name__ == "__main__":
    sys.exit(source_text.report("include_arrows", *check(source_text.root_argument())))
