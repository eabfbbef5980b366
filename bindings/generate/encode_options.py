# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: The anicodec authors
"""The options of encoding: a table of what the command, the C interface and Python have by the same words."""
import dataclasses
from typing import List, Tuple


@dataclasses.dataclass
class Choice:
    """Words of an option, each with the enumerator of C++ and the constant of the C interface that it stands for."""

    type: str
    words: List[Tuple[str, str, str]]  #: in the order of the help; "": the C interface has none
    optional: bool = False  #: nothing is chosen by default
    declared: str = ""  #: what is said of the type, where it is the command's own
    table: str = ""  #: of words: one of another header where there are none here
    host_type: str = ""  #: what the C interface makes of it, where it is another type with these enumerators


@dataclasses.dataclass
class Option:
    """name: of the command with --, of Python with _ in place of -. text: of the help."""

    name: str
    text: str
    value: str = ""  #: what stands for it in the help; "": a flag, unless there are words
    choice: Choice = None
    number: str = ""  #: the type of a number that the parser reads; else the command reads a text
    start: str = ""  #: its default, of C++
    bounds: str = "{}"  #: least and most, of C++
    repeats: bool = False
    member: str = ""  #: of EncodeChoices, where it is not the name
    sets: str = ""  #: the member of EncodeOptions that it sets as it is
    host_sets: str = ""  #: the same in the C interface alone, as the command does more
    inverted: bool = False  #: a flag that sets it to false
    field: str = ""  #: of anic_encode_options
    most: int = 0  #: of a whole number in the C interface, where 0 stands for the default
    flag: str = ""  #: of anic_encode_options.flags
    goal: str = ""  #: a target: the constant of anic_goal
    of_clip: bool = False  #: of a clip that is added to a file, too
    python: bool = True  #: the command of the package, for what it reads itself, has it as it is

    @property
    def variable(self) -> str:
        return self.member or self.name.replace("-", "_")

    @property
    def keyword(self) -> str:
        return self.name.replace("-", "_")


#: Targets that have a name, as STED. Found by looking at frames of dance, chicken, horse, flag and a captured face beside their
#: originals (`render --view original,clip`): ripples are seen at 0.1, at 0.05 only if the two are compared, at 0.02 no more.
QUALITIES = {"good": 0.05, "better": 0.02, "best": 0.01}

TARGETS = [
    Option("max-error", "Largest error of any vertex (default 0.05%)", "LEN", goal="ANIC_GOAL_MAX_ERROR"),
    Option("kg", "KG error in per cent", "PCT", goal="ANIC_GOAL_KG"),
    Option("rmse", "Root mean square error", "LEN", goal="ANIC_GOAL_RMSE"),
    Option("displacement", "Largest error of a vertex's move from frame to frame: less jitter", "LEN", goal="ANIC_GOAL_DISPLACEMENT"),
    Option("sted", "STED, a perceptual error", "X", goal="ANIC_GOAL_STED"),
    Option("quality", "Visible beside the original (good, STED 0.05), hardly (better, 0.02), not (best, 0.01)",
           choice=Choice("Quality", [("good", "kGood", ""), ("better", "kBetter", ""), ("best", "kBest", "")], optional=True,
                         declared="Targets that have a name.")),
    Option("size", "Smallest error in a file of at most 40000, 40k or 1.5M bytes", "BYTES", goal="ANIC_GOAL_SIZE"),
    Option("bpfv", "The same, as bits per frame and vertex", "BITS", goal="ANIC_GOAL_BPFV"),
    Option("lossless", "The positions come back bit for bit; the file is several times as large", flag="ANIC_ENCODE_LOSSLESS"),
]
for _option in TARGETS:
    _option.of_clip = True

METHOD = [
    Option("basis", "Kind of basis (default auto: the smallest file)", sets="basis", field="basis", of_clip=True,
           choice=Choice("BasisChoice", [("auto", "kAuto", "ANIC_CHOOSE_SMALLEST"), ("keyframes", "kKeyframes", "ANIC_CHOOSE_KEYFRAMES"),
                                         ("eigenshapes", "kEigenshapes", "ANIC_CHOOSE_EIGENSHAPES"),
                                         ("eigentrajectories", "kEigentrajectories", "ANIC_CHOOSE_EIGENTRAJECTORIES")])),
    Option("keyframes", "Number of key-frames (default: as few as do)", "K", number="uint32_t", start="0", bounds="{1, kMaxFrames}",
           field="keyframes"),
    Option("keyframe-selection", "How key-frames are chosen (default pivot)", member="selection", sets="select", field="selection",
           choice=Choice("KeyframeMethod", [("gas", "kGas", "ANIC_SELECT_GAS"), ("pivot", "kPivot", "ANIC_SELECT_PIVOT"),
                                            ("uniform", "kUniform", "ANIC_SELECT_UNIFORM")]), start="kPivot"),
    Option("interpolation", "How frames come from key-frames: linear, msgi, which decoders may lack, or auto "
           "(default linear, of --basis auto auto)", sets="interpolation", field="interpolation",
           choice=Choice("InterpolationChoice", [("linear", "kLinear", "ANIC_INTERPOLATE_LINEAR"), ("msgi", "kMsgi", "ANIC_INTERPOLATE_MSGI"),
                                                 ("auto", "kAuto", "ANIC_INTERPOLATE_BEST")], optional=True)),
    Option("keyframe-coder", "Coder of key-frames: native (default), draco, which decoders may lack, or the smaller (auto)",
           sets="keyframe_poses", field="keyframe_coder",
           choice=Choice("KeyframePoses", [("native", "kNative", "ANIC_KEYFRAMES_NATIVE"), ("draco", "kDraco", "ANIC_KEYFRAMES_DRACO"),
                                           ("auto", "kAuto", "ANIC_KEYFRAMES_SMALLEST")])),
    Option("order", "Source order kept: that of vertices, none (free), of faces too (all); default auto: vertices, of glTF and FBX "
           "scenes none", field="order", host_sets="order",
           choice=Choice("OrderChoice", [("auto", "kAuto", "ANIC_ORDER_VERTICES"), ("vertices", "kVertices", "ANIC_ORDER_VERTICES"),
                                         ("free", "kFree", "ANIC_ORDER_FREE"), ("all", "kAll", "ANIC_ORDER_ALL")],
                         host_type="OrderMode", declared="The part of the source's order that is kept. kAuto: that of the vertices, but nothing of scenes "
                         "(glTF, FBX and what else assimp reads), which carry their own faces and attributes: nobody counts on the "
                         "numbers of their vertices.")),
    Option("topology-changes", "Frames whose faces differ: refuse them (default), keep them as meshes of the file, or transfer the faces "
           "of the first frame to all", python=False,
           choice=Choice("TopologyChanges", [("refuse", "kRefuse", ""), ("keep", "kKeep", ""), ("transfer", "kTransfer", "")],
                         declared="The treatment of frames whose faces differ: an error, meshes of one file, or one mesh that has the "
                         "faces of the first frame.")),
    Option("split-objects", "Store each object of the input as a mesh, present only in the frames that show it (default: as parts of one "
           "mesh)", python=False),
    Option("effort", "How long to search (default normal)", sets="effort", field="effort", of_clip=True,
           choice=Choice("Effort", [("fast", "kFast", "ANIC_EFFORT_FAST"), ("normal", "kNormal", "ANIC_EFFORT_NORMAL"),
                                    ("best", "kBest", "ANIC_EFFORT_BEST")], table="kEfforts"), start="kNormal"),
    Option("smallest", "Make the file as small as can be, however long it takes to open (default: a balance)", sets="smallest",
           flag="ANIC_ENCODE_SMALLEST"),
]

MASSAGE = [
    Option("massage", "Move vertices along their surface first (default off)", sets="massage.mode", field="massage",
           choice=Choice("MassageMode", [("off", "kOff", "ANIC_MASSAGE_OFF"), ("on", "kOn", "ANIC_MASSAGE_ON"),
                                         ("auto", "kAuto", "ANIC_MASSAGE_AUTO")])),
    Option("massage-strength", "Weight of shape against distance, between 0 and 1 (default 0.5)", "X", number="double",
           start="MassageOptions().strength", sets="massage.options.strength", field="massage_strength"),
    Option("massage-tolerance", "How far the surface may move anywhere (default: as far as it needs)", "LEN", field="massage_tolerance",
           host_sets="massage.options.tolerance"),
]

ATTRIBUTES = [
    Option("no-attributes", "Positions and faces alone", sets="attributes.keep", inverted=True, flag="ANIC_ENCODE_NO_ATTRIBUTES"),
    Option("uv-bits", "Texture coordinates in steps of 2^-N (default 12)", "N", number="uint32_t", start="AttributeOptions().uv_bits",
           bounds="{1, 24}", sets="attributes.uv_bits", field="uv_bits", most=24),
    Option("colour-bits", "Bits for each component of a colour (default 8)", "N", number="uint32_t", start="AttributeOptions().colour_bits",
           bounds="{1, 16}", sets="attributes.colour_bits", field="colour_bits", most=16),
    Option("attribute-error", "Largest error of colours, texture coordinates and other numbers that change, in their own units or per "
           "cent of their range (default: half a step of --colour-bits for colours, 0.1% for others)", "X", field="attribute_error"),
    Option("fields", "Numbers beside positions, colours and texture coordinates that are kept (default: all)", "NAME,...|none",
           python=False),
    Option("field-error", "Largest error of one of them, or of another attribute, in its units or per cent of its range; exact: whole "
           "numbers stay as they are", "NAME=X|exact", repeats=True, member="field_errors", python=False),
    Option("field-unit", "Unit of its values, as K or m/s: shown by info", "NAME=TEXT", repeats=True, member="field_units", python=False),
    Option("store-normals", "Normals and tangents of the first frame as numbers, not only the hard edges: to within an angle in degrees, "
           "as 0.05", "DEG", member="normal_error", field="normal_error", host_sets="attributes.normals"),
]

METADATA = [
    Option("fps", "Frames per second (default: as in the input, else 24; of a scene: the grid that its keys stand on, or without one a "
           "rate of 30 or more that ends with the last)", "N[/D]", member="rate"),
    Option("up", "Axis that points up", choice=Choice("UpAxis", [], table="kUpAxes"), start="kUnknown"),
    Option("unit", "Length of a scene unit: metres, or m cm mm km in ft", "METRES"),
    Option("event", "A named time of the clip, from its first frame on, or of one of several clips", "[CLIP:]NAME=SECONDS", repeats=True,
           member="events", python=False),
    Option("meta", "Facts to store in the file, as author=, licence=, source=: shown by info", "KEY=VALUE", repeats=True,
           member="metadata", python=False),
    Option("meta-file", "The same, as a JSON object", "FILE.json", member="metadata_file", python=False),
    Option("root-motion", "Keep the motion of the whole along the ground, and its turn about the up axis, apart: a program can leave it "
           "out and move the character itself", sets="root_motion", flag="ANIC_ENCODE_ROOT_MOTION"),
    Option("loop", "The clip is meant to be repeated"),
]
for _option in METADATA:
    _option.of_clip = True

GROUPS = [("Target", TARGETS), ("Method", METHOD), ("Massage", MASSAGE), ("Attributes", ATTRIBUTES),
          ("Metadata (positions stay as they are)", METADATA)]
#: At most one of each is given.
EXCLUDED = [[o.name for o in TARGETS if o.name != "max-error"], ["max-error", "lossless"]]
