"""The morph as a document object: source and field in, morphed shape and report out.

Outputs that others show: ``ReportJson`` (the report's text) and, row by row for each node on a
face, ``NodeIds``, ``NodeFaces`` (from 1), ``NodeFeet`` (mm, on the source), ``NodeDisplacements``
(mm, factor included) and ``NodeDeviations`` (mm).
"""

SCHEMA_VERSION = 1

_FIELD, _PART, _FIT, _OUT = "Field", "Part", "Fit", "Result"

PROPERTIES = (
    ("App::PropertyLink", "Source", _PART, "The object whose solid is morphed"),
    ("App::PropertyInteger", "Solid", _PART, "Solid of the source, from 1; 0: the covered one"),
    ("App::PropertyStringList", "MovingFaces", _PART, "Only these faces move; none: all"),
    ("App::PropertyStringList", "FixedFaces", _PART, "These faces stay where they are"),
    ("App::PropertyFile", "FieldFile", _FIELD, "Displacements: .frd or CSV, gzipped or not"),
    (
        "App::PropertyFile",
        "MeshFile",
        _FIELD,
        "Deck of the mesh (.inp), for all digits of its nodes",
    ),
    (
        "App::PropertyLink",
        "FieldObject",
        _FIELD,
        "A result of the FEM workbench in place of a file",
    ),
    ("App::PropertyInteger", "Step", _FIELD, "Step of the file, from 1; 0: the last"),
    ("App::PropertyFloat", "Factor", _FIELD, "1 adds the displacements, -1 takes them away"),
    ("App::PropertyEnumeration", "FieldUnit", _FIELD, "Length unit of the field"),
    (
        "App::PropertyFloat",
        "DisplacementScale",
        _FIELD,
        "Further factor on the displacements alone",
    ),
    ("App::PropertyDistance", "Tolerance", _FIT, "Largest deviation that counts as success"),
    ("App::PropertyDistance", "MatchTolerance", _FIT, "How far a node may lie off; 0: by size"),
    ("App::PropertyBool", "Extrapolate", _FIT, "Move areas far from any node too"),
    ("App::PropertyBool", "Holdout", _FIT, "Also fit without a tenth of the nodes, as a test"),
)
OUTPUTS = (
    ("App::PropertyString", "ReportJson"),
    ("App::PropertyIntegerList", "NodeIds"),
    ("App::PropertyIntegerList", "NodeFaces"),
    ("App::PropertyVectorList", "NodeFeet"),
    ("App::PropertyVectorList", "NodeDisplacements"),
    ("App::PropertyVectorList", "NodeDeviations"),
    ("App::PropertyString", "ProductName"),
    ("App::PropertyString", "SolidName"),
    ("App::PropertyStringList", "FaceNames"),
    ("App::PropertyColorList", "FaceColors"),
)
