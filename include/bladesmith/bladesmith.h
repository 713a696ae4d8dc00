/**
 * Bladesmith: geometry for turbomachinery blades, the C interface.
 *
 * Main job: morph a CAD solid by a finite-element displacement field, hot to cold or back. Read a
 * part (bladesmith_part_read) and a field (bladesmith_field_read), morph (bladesmith_morph), take
 * the new part and the report (bladesmith_morphed_part, bladesmith_morphed_report).
 *
 * Below it, the kernel: NURBS curves and surfaces from and to arrays (bladesmith_curve_new,
 * bladesmith_surface_new), in batches, with exact reshaping and global searches.
 *
 * Units: mm unless a name or comment says otherwise; angles in degrees where a name ends in _deg.
 * Numbering: solids and faces from 1, in the order of Open CASCADE and FreeCAD.
 * Shapes: [n][3] is n times x y z in one array, last index fastest.
 * Errors: calls return a bladesmith_status, 0 for success; bladesmith_last_error() says why not.
 * Each call's comment lists what it returns besides BLADESMITH_STATUS_INTERNAL, which any may.
 * Output arguments are written only on success, unless a comment says otherwise.
 * Ownership: handles are freed by the function named like them; everything passed in is copied or
 * only read during the call.
 * Texts out come as (buffer, capacity, length): length is always set to the bytes without the NUL
 * at the end; capacity 0 only asks for it; a buffer needs length + 1 bytes.
 * Pointers: NULL only where a comment allows it or the length is 0; arrays aligned like their type.
 * Threads: any thread may call; handles never change, so many threads may read one at once.
 *
 * This file is made from the Rust sources: do not edit it.
 */

#ifndef BLADESMITH_H
#define BLADESMITH_H

#include <stddef.h>
#include <stdint.h>

/**
 * Number of the binary interface this header describes. It changes only when a program compiled
 * against an older header could no longer run; it is also the number in the so-name.
 */
#define BLADESMITH_ABI_VERSION 1

/**
 * What a call returns. Numbers are only ever added: 1-19 the caller of this interface, 100-199
 * unusable input, 200-299 numerics, 900 a fault of Bladesmith. The text to a status other than
 * BLADESMITH_STATUS_OK is given by bladesmith_last_error().
 */
typedef enum {
    /**
     * Success.
     */
    BLADESMITH_STATUS_OK = 0,
    /**
     * An argument cannot be used: NULL, misaligned, not finite, out of range.
     */
    BLADESMITH_STATUS_ARGUMENT = 1,
    /**
     * A buffer is too small; the length needed has been set.
     */
    BLADESMITH_STATUS_BUFFER_TOO_SMALL = 2,
    /**
     * The progress callback asked to stop.
     */
    BLADESMITH_STATUS_CANCELLED = 10,
    /**
     * A file could not be opened, read or written.
     */
    BLADESMITH_STATUS_IO = 100,
    /**
     * The text of a B-rep is malformed or uses something unknown.
     */
    BLADESMITH_STATUS_BREP = 110,
    /**
     * A solid that cannot be worked on.
     */
    BLADESMITH_STATUS_SOLID = 120,
    /**
     * A face that cannot be worked on.
     */
    BLADESMITH_STATUS_FACE = 121,
    /**
     * Knots, degree, poles or weights do not make a spline.
     */
    BLADESMITH_STATUS_SPLINE = 130,
    /**
     * A field or mesh file that cannot be used.
     */
    BLADESMITH_STATUS_FIELD = 150,
    /**
     * Field and solid do not belong together: position, unit, coverage.
     */
    BLADESMITH_STATUS_MISMATCH = 160,
    /**
     * A numerical method failed.
     */
    BLADESMITH_STATUS_NUMERICS = 200,
    /**
     * A fault of Bladesmith; please report it with the text.
     */
    BLADESMITH_STATUS_INTERNAL = 900,
} bladesmith_status;

/**
 * How bladesmith_parameters() spaces parameters.
 */
typedef enum {
    /**
     * Equally.
     */
    BLADESMITH_SPACING_UNIFORM = 0,
    /**
     * By the distance of neighbours.
     */
    BLADESMITH_SPACING_CHORD = 1,
    /**
     * By the distance of neighbours to a power, usually 0.5.
     */
    BLADESMITH_SPACING_CENTRIPETAL = 2,
    /**
     * By the distance in the metric of the points' own scatter (Foley and Nielson 1989).
     */
    BLADESMITH_SPACING_AFFINE_CHORD = 3,
    /**
     * As that, widened where the points turn by a factor, usually 1.5.
     */
    BLADESMITH_SPACING_AFFINE_ANGLE = 4,
} bladesmith_spacing;

/**
 * A NURBS curve in the plane or in space. Opaque and unchanging: any number of threads may use
 * one handle at once. Its lengths are in the unit of its poles, mm by convention.
 */
typedef struct bladesmith_curve bladesmith_curve;

/**
 * Curves that a call made, as many as there are. Opaque and unchanging.
 */
typedef struct bladesmith_curves bladesmith_curves;

/**
 * A displacement field on the nodes of an FE mesh. Opaque and unchanging: any number of threads
 * may use one handle at once. Lengths are in the unit of the file or the arrays it came from.
 */
typedef struct bladesmith_field bladesmith_field;

/**
 * A morphed solid with its report. Opaque and unchanging: any number of threads may use one
 * handle at once. It depends on no other handle.
 */
typedef struct bladesmith_morphed bladesmith_morphed;

/**
 * A part: the shapes of one B-rep. Opaque and unchanging: any number of threads may use one
 * handle at once. Lengths are mm.
 */
typedef struct bladesmith_part bladesmith_part;

/**
 * Where a surface meets a plane or another surface. Opaque and unchanging.
 */
typedef struct bladesmith_section bladesmith_section;

/**
 * A NURBS surface in space. Opaque and unchanging: any number of threads may use one handle at
 * once. Its lengths are in the unit of its poles, mm by convention.
 */
typedef struct bladesmith_surface bladesmith_surface;

/**
 * Surfaces that a call made, as many as there are. Opaque and unchanging.
 */
typedef struct bladesmith_surfaces bladesmith_surfaces;

/**
 * Rows of numbers that a call found, as many as there are. Opaque and unchanging.
 */
typedef struct bladesmith_table bladesmith_table;

/**
 * Settings of a morph. Fill it with bladesmith_morph_options_init() and change what you need.
 * Pointers may be NULL where their count is 0; all they point to is only read, during the call.
 */
typedef struct {
    /**
     * sizeof(bladesmith_morph_options) as you compiled it; set by bladesmith_morph_options_init().
     */
    size_t size;
    /**
     * Multiplies the displacement: 1 adds the field, -1 takes it away. Default 1.
     */
    double factor;
    /**
     * Largest deviation, in mm, that still counts as success; the fit itself aims lower. Positive;
     * default 1e-3.
     */
    double tolerance_mm;
    /**
     * How far a node may lie off the part, in mm; 0, the default, chooses from the part's size.
     */
    double match_tolerance_mm;
    /**
     * Length unit of the field in mm (1000 for metres); 0, the default, means mm and refuses a
     * field whose size shows another unit.
     */
    double field_unit_mm;
    /**
     * Further factor on the displacements alone. Default 1.
     */
    double displacement_scale;
    /**
     * Solid to morph, from 1; 0, the default, takes the only one that the field covers.
     */
    uint32_t solid;
    /**
     * Not 0: extend the field over areas without nodes however far that is. Default 0.
     */
    uint32_t extrapolate;
    /**
     * Not 0: also fit without the nodes whose number is divisible by 10, and report the error
     * there. Default 0.
     */
    uint32_t holdout;
    /**
     * Number of threads; 0, the default, uses all processors. The result does not depend on it.
     */
    uint32_t threads;
    /**
     * [moving_count] faces that move, from 1; all others stay. None: all move.
     */
    const uint32_t *moving_faces;
    /**
     * Length of moving_faces.
     */
    size_t moving_count;
    /**
     * [fixed_count] faces that stay where they are, from 1.
     */
    const uint32_t *fixed_faces;
    /**
     * Length of fixed_faces.
     */
    size_t fixed_count;
    /**
     * [face_names_count] names of the part's faces by index, for messages and the report, UTF-8;
     * NULL or "" for a face without a name.
     */
    const char *const *face_names;
    /**
     * Length of face_names: the part's number of faces, or 0.
     */
    size_t face_names_count;
    /**
     * What the report calls the solid, UTF-8; may be NULL.
     */
    const char *solid_name;
} bladesmith_morph_options;

/**
 * Called now and then during long work with the pointer that was handed in, the current stage
 * (English, valid during the call) and the fraction of the whole work that is done, from 0 to 1.
 * Return 0 to go on; anything else cancels: it is then not called again, and the work ends soon
 * with BLADESMITH_STATUS_CANCELLED. It runs on the thread that started the work, which waits for
 * it: be brief, call nothing that throws or jumps out of it, and free no handle in use.
 */
typedef int32_t (*bladesmith_progress)(void *user, const char *stage, double fraction);

#ifdef __cplusplus
extern "C" {
#endif // __cplusplus

/**
 * Number of the binary interface of the loaded library: compare it with BLADESMITH_ABI_VERSION
 * before any other call.
 *
 * Errors: none.
 */
uint32_t bladesmith_abi_version(void);

/**
 * Release of the loaded library, such as "0.1.0".
 *
 * Owner: the library; valid for ever.
 * Errors: none.
 */
const char *bladesmith_version(void);

/**
 * Why the last call on this thread that returns a status failed; "" after a success. English in
 * UTF-8: what was expected, what came, what to do.
 *
 * Owner: the library; valid until the next call on this thread that returns a status. All
 * other functions leave it alone, so what is no longer needed may be freed before reading it.
 * Errors: none; never NULL.
 */
const char *bladesmith_last_error(void);

/**
 * Reads a displacement field from a CalculiX result file (`.frd`, text or binary) or from CSV with
 * the columns id,x,y,z,dx,dy,dz; either may be gzipped.
 *
 * path: file name, NUL-terminated.
 * mesh_path: CalculiX deck (`.inp`) of the same nodes, for their full-precision coordinates
 * (an `.frd` keeps six digits), or NULL.
 * step: result step to use, from 1; 0 for the last.
 * Units: those of the file; nothing is converted.
 * Owner: `*out` is the caller's, for bladesmith_field_free(); written only on success.
 * Errors: BLADESMITH_STATUS_ARGUMENT; BLADESMITH_STATUS_IO where a file cannot be opened;
 * BLADESMITH_STATUS_FIELD with file and line where one holds no usable displacements.
 */
int32_t bladesmith_field_read(const char *path,
                              const char *mesh_path,
                              uint32_t step,
                              bladesmith_field **out);

/**
 * Makes a displacement field from arrays, which are copied.
 *
 * name: what messages and the report call it, UTF-8; NULL for "arrays".
 * ids: [nodes] node numbers in any order. Of a node given more than once the last displacement is
 * used, with a warning in the report where they differ.
 * xyz: [nodes][3] coordinates of the nodes.
 * u: [nodes][3] displacements.
 * Units: one and the same length unit for xyz and u; mm unless the options of the morph say
 * otherwise.
 * Owner: `*out` is the caller's, for bladesmith_field_free(); written only on success.
 * Errors: BLADESMITH_STATUS_ARGUMENT, also for values that are not finite; BLADESMITH_STATUS_FIELD
 * for no nodes or a node at two places.
 */
int32_t bladesmith_field_from_arrays(const char *name,
                                     const int64_t *ids,
                                     const double *xyz,
                                     const double *u,
                                     size_t nodes,
                                     bladesmith_field **out);

/**
 * What is in a field, as JSON: {"name", "format", "compressed", "mesh", "blocks": [{"name", "rows"}],
 * "steps": [{"number", "time", "rows", ...}], "step", "nodes", "nodes_with_result", "surface_nodes",
 * "elements": [{"kind", "count"}], "bounds": [[x, y, z], [x, y, z]], "unit_guess",
 * "largest_displacement": {"value", "node", "at": [x, y, z]}, "warnings": [...]}. What a file does
 * not tell is null.
 *
 * Units: those of the field.
 * Text: `*length` is set to the bytes without the NUL; capacity 0 only asks for it.
 * Owner: the caller gives the buffer.
 * Errors: BLADESMITH_STATUS_ARGUMENT; BLADESMITH_STATUS_BUFFER_TOO_SMALL, with `*length` set and
 * the buffer left alone.
 */
int32_t bladesmith_field_info(const bladesmith_field *field,
                              char *json,
                              size_t capacity,
                              size_t *length);

/**
 * Frees a field; NULL is fine. No call may be using it.
 *
 * Owner: the library again; the handle must not be used any more.
 * Errors: none.
 */
void bladesmith_field_free(bladesmith_field *field);

/**
 * Reads a part from Open CASCADE's text B-rep (versions 1 to 3), as FreeCAD's exportBrepToString
 * writes it.
 *
 * text: [length] bytes; a NUL at the end is not needed.
 * name: what messages call the text, UTF-8; NULL for "B-rep".
 * Units: mm.
 * Owner: `*out` is the caller's, for bladesmith_part_free(); written only on success. The text is
 * copied.
 * Errors: BLADESMITH_STATUS_ARGUMENT; BLADESMITH_STATUS_BREP with the line where the text is
 * malformed.
 */
int32_t bladesmith_part_read(const char *text,
                             size_t length,
                             const char *name,
                             bladesmith_part **out);

/**
 * What is in a part, as JSON: {"solids": [{"index", "closed", "faces": [...]}], "faces": [{"index",
 * "surface", "degree": [u, v], "poles": [u, v], "rational"}], "edges", "vertices",
 * "bounding_box_mm": [[x, y, z], [x, y, z]]}. Faces are numbered from 1 in the order of Open
 * CASCADE's and FreeCAD's; degree and poles are null for surfaces without poles.
 *
 * Units: mm. The box is that of points on the faces and edges: it may fall short of the true one
 * by the sag between them.
 * Text: `*length` is set to the bytes without the NUL; capacity 0 only asks for it.
 * Owner: the caller gives the buffer.
 * Errors: BLADESMITH_STATUS_ARGUMENT; BLADESMITH_STATUS_BUFFER_TOO_SMALL, with `*length` set and
 * the buffer left alone; BLADESMITH_STATUS_BREP, BLADESMITH_STATUS_FACE, BLADESMITH_STATUS_SPLINE
 * for shapes that do not hang together.
 */
int32_t bladesmith_part_info(const bladesmith_part *part,
                             char *json,
                             size_t capacity,
                             size_t *length);

/**
 * Writes a part as Open CASCADE's text B-rep, for FreeCAD's importBrepFromString. Numbers are
 * written so that they read back the same to the last bit.
 *
 * Units: mm.
 * Text: `*length` is set to the bytes without the NUL; capacity 0 only asks for it.
 * Owner: the caller gives the buffer.
 * Errors: BLADESMITH_STATUS_ARGUMENT; BLADESMITH_STATUS_BUFFER_TOO_SMALL, with `*length` set and
 * the buffer left alone.
 */
int32_t bladesmith_part_write(const bladesmith_part *part,
                              char *text,
                              size_t capacity,
                              size_t *length);

/**
 * Points and derivatives of the surface under a face, trims left aside.
 *
 * face: number of the face, from 1.
 * uv: [points][2] surface parameters.
 * order: highest derivative, 0 to 2.
 * out: [points][3 * k], where k is 1, 3 or 6 for order 0, 1 or 2: S, then S_u S_v, then
 * S_uu S_uv S_vv, x y z each. A reversed face does not change them; they are NaN where the basis
 * of an offset surface has no normal.
 * Units: mm, and mm per parameter.
 * Owner: the caller gives the arrays; out is written only on success.
 * Errors: BLADESMITH_STATUS_ARGUMENT, also for a face that is not there or parameters that are not
 * finite; BLADESMITH_STATUS_BREP, BLADESMITH_STATUS_FACE, BLADESMITH_STATUS_SPLINE for shapes that
 * do not hang together.
 */
int32_t bladesmith_part_evaluate(const bladesmith_part *part,
                                 uint32_t face,
                                 const double *uv,
                                 size_t points,
                                 uint32_t order,
                                 double *out);

/**
 * Frees a part; NULL is fine. No call may be using it.
 *
 * Owner: the library again; the handle must not be used any more.
 * Errors: none.
 */
void bladesmith_part_free(bladesmith_part *part);

/**
 * Sets all options to their defaults.
 *
 * options: the struct to fill; nothing happens if it is NULL.
 * size: sizeof(bladesmith_morph_options); bytes that this library does not know become 0, and so
 * does everything if the struct is smaller than any released one, which bladesmith_morph() then
 * refuses.
 * Owner: the caller's struct; it holds nothing to be freed.
 * Errors: none.
 */
void bladesmith_morph_options_init(bladesmith_morph_options *options, size_t size);

/**
 * How a field lies on a part, as JSON, for a look before bladesmith_morph(): {"nodes",
 * "nodes_on_faces", "unmatched_nodes", "foot_mm": {"mean", "max"}, "match_tolerance_mm",
 * "faces_without_nodes": [...], "warnings": [...]}. It does the first stages of a morph, about a
 * third of the work, and fails where that would refuse the input.
 *
 * options: NULL for the defaults.
 * progress, user: called on this thread with user; progress may be NULL.
 * Units: mm.
 * Text: `*length` is set to the bytes without the NUL; capacity 0 only asks for it. Each call does
 * the work: a buffer of 64 kB is nearly always enough for the first.
 * Owner: the caller gives the buffer.
 * Errors: those of bladesmith_morph(); BLADESMITH_STATUS_BUFFER_TOO_SMALL, with `*length` set and
 * the buffer left alone.
 */
int32_t bladesmith_check(const bladesmith_part *part,
                         const bladesmith_field *field,
                         const bladesmith_morph_options *options,
                         bladesmith_progress progress,
                         void *user,
                         char *json,
                         size_t capacity,
                         size_t *length);

/**
 * Morphs one solid of a part by a field: x_out = x_in + factor * u(x_in) for every face, edge and
 * vertex, with the same topology and the same order of faces.
 *
 * options: NULL for the defaults.
 * progress, user: called on this thread with user; progress may be NULL.
 * Units: mm, and those the options name. Equal input gives equal results, to the last bit.
 * Owner: `*out` is the caller's, for bladesmith_morphed_free(); written only on success. Part and
 * field may be freed before it.
 * Errors: BLADESMITH_STATUS_ARGUMENT; BLADESMITH_STATUS_CANCELLED; BLADESMITH_STATUS_SOLID,
 * BLADESMITH_STATUS_FACE, BLADESMITH_STATUS_SPLINE for a part that cannot be worked on;
 * BLADESMITH_STATUS_MISMATCH where field and part do not belong together;
 * BLADESMITH_STATUS_NUMERICS. A deviation above tolerance_mm is no error: compare the report's
 * deviation_mm.max.
 */
int32_t bladesmith_morph(const bladesmith_part *part,
                         const bladesmith_field *field,
                         const bladesmith_morph_options *options,
                         bladesmith_progress progress,
                         void *user,
                         bladesmith_morphed **out);

/**
 * The morphed solid as a part of its own.
 *
 * Owner: `*out` is the caller's, for bladesmith_part_free(); written only on success. It does not
 * depend on the handle it came from.
 * Errors: BLADESMITH_STATUS_ARGUMENT.
 */
int32_t bladesmith_morphed_part(const bladesmith_morphed *morphed, bladesmith_part **out);

/**
 * The report of a morph as JSON: {"deviation_mm": {"mean", "max"}, "faces": [...], "edges": [...],
 * "solid": {...}, "warnings": [...], "seconds": {...}, ...}: deviations at the nodes by face, gaps
 * and angles at every edge, volume, area and tolerances before and after, warnings, times.
 *
 * Units: mm, mm^2, mm^3, degrees, seconds; each name says so.
 * Text: `*length` is set to the bytes without the NUL; capacity 0 only asks for it.
 * Owner: the caller gives the buffer.
 * Errors: BLADESMITH_STATUS_ARGUMENT; BLADESMITH_STATUS_BUFFER_TOO_SMALL, with `*length` set and
 * the buffer left alone.
 */
int32_t bladesmith_morphed_report(const bladesmith_morphed *morphed,
                                  char *json,
                                  size_t capacity,
                                  size_t *length);

/**
 * What became of every FE node on every face it lies on, for colour maps and tables. A node on an
 * edge has an entry for each face that meets there.
 *
 * capacity: entries that each array given has room for; 0 only asks for their number.
 * ids: [capacity] node numbers.
 * faces: [capacity] faces, from 1.
 * feet: [capacity][3] foot points on the input solid.
 * displacements: [capacity][3] displacements applied there, factor included.
 * deviations: [capacity][3] what the output surface misses there.
 * Any of the arrays may be NULL and is then left out.
 * count: set to the number of entries, also where the arrays are too small.
 * Units: mm.
 * Owner: the caller gives the arrays.
 * Errors: BLADESMITH_STATUS_ARGUMENT; BLADESMITH_STATUS_BUFFER_TOO_SMALL, with `*count` set and
 * the arrays left alone.
 */
int32_t bladesmith_morphed_nodes(const bladesmith_morphed *morphed,
                                 size_t capacity,
                                 int64_t *ids,
                                 uint32_t *faces,
                                 double *feet,
                                 double *displacements,
                                 double *deviations,
                                 size_t *count);

/**
 * Frees a morphed solid; NULL is fine. No call may be using it.
 *
 * Owner: the library again; the handle must not be used any more.
 * Errors: none.
 */
void bladesmith_morphed_free(bladesmith_morphed *morphed);

/**
 * Makes a curve from arrays, which are copied.
 *
 * dimension: coordinates of a point, 2 or 3.
 * degree: 1 to 25.
 * knots: [knot_count] all knots, repeated by multiplicity, not decreasing. The domain runs from
 * knots[degree] to knots[pole_count]; the ends need not be repeated (closed curves repeat poles).
 * poles: [pole_count][dimension], where pole_count is knot_count - degree - 1.
 * weights: [pole_count] positive weights, or NULL for a polynomial curve.
 * Units: one length unit for all coordinates, mm by convention.
 * Owner: `*out` is the caller's, for bladesmith_curve_free(); written only on success.
 * Errors: BLADESMITH_STATUS_ARGUMENT; BLADESMITH_STATUS_SPLINE for arrays that make no curve.
 */
int32_t bladesmith_curve_new(uint32_t dimension,
                             uint32_t degree,
                             const double *knots,
                             size_t knot_count,
                             const double *poles,
                             const double *weights,
                             size_t pole_count,
                             bladesmith_curve **out);

/**
 * Sizes of a curve. Any of the outputs may be NULL.
 *
 * dimension: 2 or 3.
 * degree: 1 to 25.
 * pole_count: number of poles; there are pole_count + degree + 1 knots.
 * rational: 1 for a curve with weights, 0 for a polynomial one.
 * Owner: the caller gives the places.
 * Errors: BLADESMITH_STATUS_ARGUMENT.
 */
int32_t bladesmith_curve_size(const bladesmith_curve *curve,
                              uint32_t *dimension,
                              uint32_t *degree,
                              size_t *pole_count,
                              uint32_t *rational);

/**
 * Knots, poles and weights of a curve. Any of the arrays may be NULL.
 *
 * pole_count: as bladesmith_curve_size() tells it; anything else is refused.
 * knots: [pole_count + degree + 1].
 * poles: [pole_count][dimension].
 * weights: [pole_count], all 1 for a polynomial curve.
 * Units: those of the curve.
 * Owner: the caller gives the arrays; written only on success.
 * Errors: BLADESMITH_STATUS_ARGUMENT.
 */
int32_t bladesmith_curve_data(const bladesmith_curve *curve,
                              size_t pole_count,
                              double *knots,
                              double *poles,
                              double *weights);

/**
 * Points and derivatives of a curve.
 *
 * t: [count] parameters, finite. Outside the domain the end spans are continued.
 * order: highest derivative, 0 to 25.
 * below: not 0: where a knot makes derivatives jump, those from smaller parameters; 0: those from
 * larger ones (at the end of the domain there is one kind only).
 * out: [count][order + 1][dimension] the point, then the first derivative, and so on.
 * Units: mm, and mm per parameter to the power of the order.
 * Owner: the caller gives the arrays; out is written only on success.
 * Errors: BLADESMITH_STATUS_ARGUMENT.
 */
int32_t bladesmith_curve_evaluate(const bladesmith_curve *curve,
                                  const double *t,
                                  size_t count,
                                  uint32_t order,
                                  uint32_t below,
                                  double *out);

/**
 * Frames and curvatures of a curve. Any of the outputs may be NULL; where the curve stands still
 * all are NaN.
 *
 * t: [count] parameters, finite.
 * axes: [count][dimension][dimension] unit tangent, unit normal and, in space, unit binormal. In
 * the plane the normal is to the left of the tangent; in space it points to the centre of
 * curvature, and where the curve is straight it is any one.
 * curvatures: [count], in the plane positive where the curve turns left, in space never negative.
 * torsions: [count], 0 in the plane.
 * Units: curvature and torsion 1/mm.
 * Owner: the caller gives the arrays; written only on success.
 * Errors: BLADESMITH_STATUS_ARGUMENT.
 */
int32_t bladesmith_curve_frames(const bladesmith_curve *curve,
                                const double *t,
                                size_t count,
                                double *axes,
                                double *curvatures,
                                double *torsions);

/**
 * Arc lengths from the start of the domain to parameters.
 *
 * tolerance: bound of the estimated error of the whole length, positive.
 * t: [count] parameters, finite; those outside the domain are taken to its ends.
 * out: [count] lengths.
 * Units: mm.
 * Owner: the caller gives the arrays; out is written only on success.
 * Errors: BLADESMITH_STATUS_ARGUMENT; BLADESMITH_STATUS_NUMERICS for a tolerance that cannot be reached.
 */
int32_t bladesmith_curve_lengths(const bladesmith_curve *curve,
                                 double tolerance,
                                 const double *t,
                                 size_t count,
                                 double *out);

/**
 * Parameters at arc lengths from the start of the domain.
 *
 * tolerance: bound of the estimated error of the whole length, positive.
 * lengths: [count] finite; those beyond the ends give the ends.
 * out: [count] parameters.
 * Units: mm.
 * Owner: the caller gives the arrays; out is written only on success.
 * Errors: BLADESMITH_STATUS_ARGUMENT; BLADESMITH_STATUS_NUMERICS for a tolerance that cannot be reached.
 */
int32_t bladesmith_curve_at_lengths(const bladesmith_curve *curve,
                                    double tolerance,
                                    const double *lengths,
                                    size_t count,
                                    double *out);

/**
 * Frees a curve; NULL is fine. No call may be using it.
 *
 * Owner: the library again; the handle must not be used any more.
 * Errors: none.
 */
void bladesmith_curve_free(bladesmith_curve *curve);

/**
 * Numbers of rows and columns of a table.
 *
 * Owner: the caller gives the places.
 * Errors: BLADESMITH_STATUS_ARGUMENT.
 */
int32_t bladesmith_table_size(const bladesmith_table *table, size_t *rows, size_t *columns);

/**
 * The numbers of a table.
 *
 * rows: how many rows `out` has room for; fewer than bladesmith_table_size() tells are refused.
 * out: [rows][columns]. What the columns are is told where the table comes from.
 * Units: told there as well.
 * Owner: the caller gives the array; written only on success.
 * Errors: BLADESMITH_STATUS_ARGUMENT; BLADESMITH_STATUS_BUFFER_TOO_SMALL.
 */
int32_t bladesmith_table_data(const bladesmith_table *table, size_t rows, double *out);

/**
 * Frees a table; NULL is fine. No call may be using it.
 *
 * Owner: the library again; the handle must not be used any more.
 * Errors: none.
 */
void bladesmith_table_free(bladesmith_table *table);

/**
 * The Bézier segments of a curve, each over the span it came from.
 *
 * Owner: `*out` is the caller's, for bladesmith_curves_free(); written only on success.
 * Errors: BLADESMITH_STATUS_ARGUMENT; BLADESMITH_STATUS_SPLINE for curves that jump.
 */
int32_t bladesmith_curve_bezier(const bladesmith_curve *curve, bladesmith_curves **out);

/**
 * The same curves with one degree, one domain (that of the first) and the same clamped knots, and
 * with weights if one has them.
 *
 * curves: [count] curves of one dimension, at least one.
 * Owner: `*out` is the caller's, for bladesmith_curves_free(); written only on success.
 * Errors: BLADESMITH_STATUS_ARGUMENT; BLADESMITH_STATUS_SPLINE for curves that jump.
 */
int32_t bladesmith_curves_compatible(const bladesmith_curve *const *curves,
                                     size_t count,
                                     bladesmith_curves **out);

/**
 * Number of curves.
 *
 * Owner: the caller gives the place.
 * Errors: BLADESMITH_STATUS_ARGUMENT.
 */
int32_t bladesmith_curves_count(const bladesmith_curves *curves, size_t *count);

/**
 * One of the curves, as a handle of its own.
 *
 * index: from 0.
 * Owner: `*out` is the caller's, for bladesmith_curve_free(); written only on success.
 * Errors: BLADESMITH_STATUS_ARGUMENT, also for an index that is not there.
 */
int32_t bladesmith_curves_get(const bladesmith_curves *curves,
                              size_t index,
                              bladesmith_curve **out);

/**
 * Frees the list; NULL is fine. Curves taken from it stay. No call may be using it.
 *
 * Owner: the library again; the handle must not be used any more.
 * Errors: none.
 */
void bladesmith_curves_free(bladesmith_curves *curves);

/**
 * The same curve with knots inserted.
 *
 * knots: [count] in the inside of the domain, not decreasing; one that comes twice is inserted
 * twice.
 * Units: those of the parameter.
 * Owner: `*out` is the caller's, for bladesmith_curve_free(); written only on success.
 * Errors: BLADESMITH_STATUS_ARGUMENT; BLADESMITH_STATUS_SPLINE where a knot lies elsewhere or would
 * stand more often than the degree.
 */
int32_t bladesmith_curve_refine(const bladesmith_curve *curve,
                                const double *knots,
                                size_t count,
                                bladesmith_curve **out);

/**
 * The curve with a knot removed as often as the curve moves by no more than a tolerance in all.
 * How often it was removed shows in the knots.
 *
 * t: the knot, exactly.
 * times: how often it shall be removed, at most as often as it stands there.
 * tolerance: not negative.
 * moved: [1] is set to a bound of the movement; may be NULL.
 * Units: tolerance and moved mm.
 * Owner: `*out` is the caller's, for bladesmith_curve_free(); written only on success.
 * Errors: BLADESMITH_STATUS_ARGUMENT; BLADESMITH_STATUS_SPLINE for a knot that does not stand
 * there so often.
 */
int32_t bladesmith_curve_remove_knot(const bladesmith_curve *curve,
                                     double t,
                                     uint32_t times,
                                     double tolerance,
                                     double *moved,
                                     bladesmith_curve **out);

/**
 * The same curve, clamped, with its degree raised.
 *
 * by: by how much; the new degree is at most 25.
 * Owner: `*out` is the caller's, for bladesmith_curve_free(); written only on success.
 * Errors: BLADESMITH_STATUS_ARGUMENT; BLADESMITH_STATUS_SPLINE beyond the highest degree and for
 * curves that jump.
 */
int32_t bladesmith_curve_elevate(const bladesmith_curve *curve,
                                 uint32_t by,
                                 bladesmith_curve **out);

/**
 * A curve of a degree lower by one that is, at equal parameters, no further away than a tolerance.
 *
 * tolerance: not negative.
 * moved: [1] is set to a bound of the distance; may be NULL.
 * Units: mm.
 * Owner: `*out` is the caller's, for bladesmith_curve_free(); written only on success.
 * Errors: BLADESMITH_STATUS_ARGUMENT; BLADESMITH_STATUS_NUMERICS where the tolerance cannot be met;
 * BLADESMITH_STATUS_SPLINE for degree 1 and curves that jump.
 */
int32_t bladesmith_curve_reduce(const bladesmith_curve *curve,
                                double tolerance,
                                double *moved,
                                bladesmith_curve **out);

/**
 * The part of a curve between two parameters, which keep their meaning; two parts split it.
 *
 * from, to: ascending, in the domain.
 * Owner: `*out` is the caller's, for bladesmith_curve_free(); written only on success.
 * Errors: BLADESMITH_STATUS_ARGUMENT; BLADESMITH_STATUS_SPLINE for an empty part or one outside.
 */
int32_t bladesmith_curve_part(const bladesmith_curve *curve,
                              double from,
                              double to,
                              bladesmith_curve **out);

/**
 * The curve run backwards, over the same domain.
 *
 * Owner: `*out` is the caller's, for bladesmith_curve_free(); written only on success.
 * Errors: BLADESMITH_STATUS_ARGUMENT.
 */
int32_t bladesmith_curve_reverse(const bladesmith_curve *curve, bladesmith_curve **out);

/**
 * The same curve over another domain.
 *
 * from, to: ascending.
 * Owner: `*out` is the caller's, for bladesmith_curve_free(); written only on success.
 * Errors: BLADESMITH_STATUS_ARGUMENT; BLADESMITH_STATUS_SPLINE for an empty domain.
 */
int32_t bladesmith_curve_over(const bladesmith_curve *curve,
                              double from,
                              double to,
                              bladesmith_curve **out);

/**
 * The same curve with end knots repeated degree + 1 times, as most programs want them.
 *
 * Owner: `*out` is the caller's, for bladesmith_curve_free(); written only on success.
 * Errors: BLADESMITH_STATUS_ARGUMENT; BLADESMITH_STATUS_SPLINE where rounding leaves no such knots.
 */
int32_t bladesmith_curve_clamp(const bladesmith_curve *curve, bladesmith_curve **out);

/**
 * The image of a curve under an affine map, exactly.
 *
 * matrix: [3][4]: row by row, the last column a shift. A curve in the plane has z = 0.
 * dimension: of the image, 2 or 3; 2 leaves its z out.
 * Units: the shift as the poles.
 * Owner: `*out` is the caller's, for bladesmith_curve_free(); written only on success.
 * Errors: BLADESMITH_STATUS_ARGUMENT; BLADESMITH_STATUS_SPLINE where numbers overflow.
 */
int32_t bladesmith_curve_map(const bladesmith_curve *curve,
                             const double *matrix,
                             uint32_t dimension,
                             bladesmith_curve **out);

/**
 * One curve, and behind it another, as one.
 *
 * next: a curve of the same dimension that starts where the first ends.
 * gap: how far apart they may be there; they meet in the middle.
 * smooth: 0: each keeps its parametrisation, that of next shifted; not 0: the speed of next is
 * brought to that of curve, and the joint made as smooth as moving by no more than gap allows.
 * Units: gap mm.
 * Owner: `*out` is the caller's, for bladesmith_curve_free(); written only on success.
 * Errors: BLADESMITH_STATUS_ARGUMENT; BLADESMITH_STATUS_SPLINE for ends further apart than gap;
 * BLADESMITH_STATUS_NUMERICS where smooth curves stand still at the joint.
 */
int32_t bladesmith_curve_join(const bladesmith_curve *curve,
                              const bladesmith_curve *next,
                              double gap,
                              uint32_t smooth,
                              bladesmith_curve **out);

/**
 * The arc centre + x cos a + y sin a for angles a from one to another, exactly: of a circle where
 * x and y are perpendicular and as long as the radius, else of the ellipse with these conjugate
 * semi-diameters. Its domain is [0, 1].
 *
 * centre, x, y: [dimension] each, dimension 2 or 3.
 * from, to: angles in rad; to less than from runs clockwise; at most a full turn.
 * Units: mm.
 * Owner: `*out` is the caller's, for bladesmith_curve_free(); written only on success.
 * Errors: BLADESMITH_STATUS_ARGUMENT, also for an empty sweep or more than a turn.
 */
int32_t bladesmith_curve_arc(uint32_t dimension,
                             const double *centre,
                             const double *x,
                             const double *y,
                             double from,
                             double to,
                             bladesmith_curve **out);

/**
 * The conic segment from start to end that is tangent there to the lines through a corner. Its
 * domain is [0, 1].
 *
 * start, corner, end: [dimension] each, dimension 2 or 3.
 * through: [dimension] a point inside their triangle that the segment passes, or NULL.
 * weight: without such a point, the weight of the corner: below 1 an ellipse, 1 a parabola, above
 * a hyperbola.
 * Units: mm.
 * Owner: `*out` is the caller's, for bladesmith_curve_free(); written only on success.
 * Errors: BLADESMITH_STATUS_ARGUMENT, also for a point outside the triangle;
 * BLADESMITH_STATUS_SPLINE for a weight that is not positive.
 */
int32_t bladesmith_curve_conic(uint32_t dimension,
                               const double *start,
                               const double *corner,
                               const double *end,
                               const double *through,
                               double weight,
                               bladesmith_curve **out);

/**
 * The closed curve that goes on smoothly over its seam: its knots are unclamped and repeat by the
 * period.
 *
 * dimension: 2 or 3.
 * degree: 1 to 25.
 * breaks: [break_count] ascending, the domain from the first to the last.
 * poles: [break_count - 1][dimension], each once.
 * weights: [break_count - 1] positive weights, or NULL for a polynomial curve.
 * Units: one length unit for all coordinates, mm by convention.
 * Owner: `*out` is the caller's, for bladesmith_curve_free(); written only on success.
 * Errors: BLADESMITH_STATUS_ARGUMENT; BLADESMITH_STATUS_SPLINE for arrays that make no curve.
 */
int32_t bladesmith_curve_periodic(uint32_t dimension,
                                  uint32_t degree,
                                  const double *breaks,
                                  size_t break_count,
                                  const double *poles,
                                  const double *weights,
                                  bladesmith_curve **out);

/**
 * Parameters for points that a curve shall pass, ascending from 0 to 1.
 *
 * dimension: 2 or 3.
 * points: [count][dimension], at least two; neighbours may coincide with uniform spacing only.
 * spacing: one of bladesmith_spacing.
 * factor: the power of BLADESMITH_SPACING_CENTRIPETAL or the factor of
 * BLADESMITH_SPACING_AFFINE_ANGLE, not negative; others ignore it.
 * out: [count].
 * Units: any length.
 * Owner: the caller gives the arrays; out is written only on success.
 * Errors: BLADESMITH_STATUS_ARGUMENT.
 */
int32_t bladesmith_parameters(uint32_t dimension,
                              const double *points,
                              size_t count,
                              uint32_t spacing,
                              double factor,
                              double *out);

/**
 * Clamped knots for a curve through points: inner ones are means of neighbouring parameters, as
 * bladesmith_curve_interpolate() takes them by itself.
 *
 * degree: 1 to 25.
 * parameters: [count] ascending, more than degree.
 * out: [count + degree + 1].
 * Units: those of the parameter.
 * Owner: the caller gives the arrays; out is written only on success.
 * Errors: BLADESMITH_STATUS_ARGUMENT; BLADESMITH_STATUS_SPLINE for too few or descending parameters.
 */
int32_t bladesmith_averaged_knots(uint32_t degree,
                                  const double *parameters,
                                  size_t count,
                                  double *out);

/**
 * The curve of a degree that passes points, or has derivatives, at parameters.
 *
 * dimension: 2 or 3.
 * parameters: [count], in any order.
 * orders: [count] what is given at each: 0 the point, 1 the first derivative, and so on up to the
 * degree; NULL for points alone.
 * values: [count][dimension].
 * knots: [knot_count], as many as count + degree + 1; or NULL with a knot_count of 0 for clamped
 * knots that are means of neighbouring parameters.
 * Units: mm, and mm per parameter to the power of the order.
 * Owner: `*out` is the caller's, for bladesmith_curve_free(); written only on success.
 * Errors: BLADESMITH_STATUS_ARGUMENT for conditions that contradict or are too many or few;
 * BLADESMITH_STATUS_SPLINE where they do not fit the knots (Schoenberg and Whitney);
 * BLADESMITH_STATUS_NUMERICS where they do not determine a curve.
 */
int32_t bladesmith_curve_interpolate(uint32_t dimension,
                                     uint32_t degree,
                                     const double *parameters,
                                     const uint32_t *orders,
                                     const double *values,
                                     size_t count,
                                     const double *knots,
                                     size_t knot_count,
                                     bladesmith_curve **out);

/**
 * The closed curve, smooth at its seam as everywhere, that passes points at parameters; its knots are
 * periodic. Odd degrees have them at the parameters, even ones halfway between.
 *
 * dimension: 2 or 3.
 * degree: 1 to 25, less than count.
 * parameters: [count + 1] ascending, the last where the first point is passed again.
 * points: [count][dimension], the first not repeated.
 * Units: mm.
 * Owner: `*out` is the caller's, for bladesmith_curve_free(); written only on success.
 * Errors: BLADESMITH_STATUS_ARGUMENT; BLADESMITH_STATUS_NUMERICS for parameters so uneven that they do
 * not determine a curve.
 */
int32_t bladesmith_curve_interpolate_closed(uint32_t dimension,
                                            uint32_t degree,
                                            const double *parameters,
                                            const double *points,
                                            size_t count,
                                            bladesmith_curve **out);

/**
 * The curve over given knots with the least sum of weighted squared distances to points at their
 * parameters, with given derivatives at its ends.
 *
 * dimension: 2 or 3.
 * degree, knots: [knot_count] as in bladesmith_curve_new().
 * parameters: [count] in the domain of the knots.
 * points: [count][dimension].
 * weights: [count] not negative, or NULL for 1 each.
 * start, end: [start_count][dimension] and [end_count][dimension]: the point at the end of the
 * domain, then the first derivative there, and so on; a count of 0 leaves the end free. They need
 * clamped knots.
 * Units: mm, and mm per parameter to the power of the order.
 * Owner: `*out` is the caller's, for bladesmith_curve_free(); written only on success.
 * Errors: BLADESMITH_STATUS_ARGUMENT; BLADESMITH_STATUS_SPLINE where points are too few for the
 * knots, or badly placed (Schoenberg and Whitney).
 */
int32_t bladesmith_curve_fit(uint32_t dimension,
                             uint32_t degree,
                             const double *knots,
                             size_t knot_count,
                             const double *parameters,
                             const double *points,
                             const double *weights,
                             size_t count,
                             const double *start,
                             size_t start_count,
                             const double *end,
                             size_t end_count,
                             bladesmith_curve **out);

/**
 * The curve over given knots with the least sum of weighted squared distances to points, plus
 * smoothing times the integral of its squared second derivative: for small values it comes near
 * the points, for large ones near a straight line.
 *
 * dimension, degree, knots, parameters, points, weights: as in bladesmith_curve_fit(): [knot_count],
 * [count], [count][dimension], [count].
 * smoothing: above 0.
 * Units: mm; smoothing the third power of the parameter's unit.
 * Owner: `*out` is the caller's, for bladesmith_curve_free(); written only on success.
 * Errors: BLADESMITH_STATUS_ARGUMENT; BLADESMITH_STATUS_NUMERICS for less than two parameters.
 */
int32_t bladesmith_curve_smooth(uint32_t dimension,
                                uint32_t degree,
                                const double *knots,
                                size_t knot_count,
                                const double *parameters,
                                const double *points,
                                const double *weights,
                                size_t count,
                                double smoothing,
                                bladesmith_curve **out);

/**
 * The smoothest curve over given knots whose weighted squared distances to points sum up to no
 * more than a residual.
 *
 * dimension, degree, knots, parameters, points, weights: as in bladesmith_curve_fit(): [knot_count],
 * [count], [count][dimension], [count].
 * residual: not negative.
 * smoothing: [1] is set to what bladesmith_curve_smooth() needs for the same curve; may be NULL.
 * Units: residual mm^2.
 * Owner: `*out` is the caller's, for bladesmith_curve_free(); written only on success.
 * Errors: BLADESMITH_STATUS_ARGUMENT; BLADESMITH_STATUS_NUMERICS where the knots leave more than the
 * residual, or for less than two parameters.
 */
int32_t bladesmith_curve_smooth_within(uint32_t dimension,
                                       uint32_t degree,
                                       const double *knots,
                                       size_t knot_count,
                                       const double *parameters,
                                       const double *points,
                                       const double *weights,
                                       size_t count,
                                       double residual,
                                       double *smoothing,
                                       bladesmith_curve **out);

/**
 * Makes a surface from arrays, which are copied.
 *
 * degree_u, degree_v: 1 to 25.
 * knots_u, knots_v: [knot_count_u] and [knot_count_v] all knots along u and v, as in
 * bladesmith_curve_new(); they ask for n = knot_count_u - degree_u - 1 rows of
 * m = knot_count_v - degree_v - 1 poles.
 * poles: [n][m][3], v fastest.
 * weights: [n][m] positive weights, or NULL for a polynomial surface.
 * pole_count: n * m.
 * Units: one length unit for all coordinates, mm by convention.
 * Owner: `*out` is the caller's, for bladesmith_surface_free(); written only on success.
 * Errors: BLADESMITH_STATUS_ARGUMENT; BLADESMITH_STATUS_SPLINE for arrays that make no surface.
 */
int32_t bladesmith_surface_new(uint32_t degree_u,
                               uint32_t degree_v,
                               const double *knots_u,
                               size_t knot_count_u,
                               const double *knots_v,
                               size_t knot_count_v,
                               const double *poles,
                               const double *weights,
                               size_t pole_count,
                               bladesmith_surface **out);

/**
 * Sizes of a surface. Any of the outputs may be NULL.
 *
 * degree_u, degree_v: 1 to 25.
 * pole_count_u, pole_count_v: poles along u and v; there are as many knots and degree + 1 more.
 * rational: 1 for a surface with weights, 0 for a polynomial one.
 * Owner: the caller gives the places.
 * Errors: BLADESMITH_STATUS_ARGUMENT.
 */
int32_t bladesmith_surface_size(const bladesmith_surface *surface,
                                uint32_t *degree_u,
                                uint32_t *degree_v,
                                size_t *pole_count_u,
                                size_t *pole_count_v,
                                uint32_t *rational);

/**
 * Knots, poles and weights of a surface. Any of the arrays may be NULL.
 *
 * pole_count: all poles, n * m of bladesmith_surface_size(); anything else is refused.
 * knots_u, knots_v: [n + degree_u + 1] and [m + degree_v + 1].
 * poles: [n][m][3].
 * weights: [n][m], all 1 for a polynomial surface.
 * Units: those of the surface.
 * Owner: the caller gives the arrays; written only on success.
 * Errors: BLADESMITH_STATUS_ARGUMENT.
 */
int32_t bladesmith_surface_data(const bladesmith_surface *surface,
                                size_t pole_count,
                                double *knots_u,
                                double *knots_v,
                                double *poles,
                                double *weights);

/**
 * Points and derivatives of a surface.
 *
 * uv: [count][2] parameters, finite. Outside the domain the end spans are continued.
 * order: highest total order of derivatives, 0 to 25.
 * below_u, below_v: not 0: where a knot along this direction makes derivatives jump, those from
 * smaller parameters; 0: those from larger ones.
 * out: [count][(order + 1) * (order + 2) / 2][3]: S; S_u, S_v; S_uu, S_uv, S_vv; and so on.
 * Units: mm, and mm per parameter to the power of the order.
 * Owner: the caller gives the arrays; out is written only on success.
 * Errors: BLADESMITH_STATUS_ARGUMENT.
 */
int32_t bladesmith_surface_evaluate(const bladesmith_surface *surface,
                                    const double *uv,
                                    size_t count,
                                    uint32_t order,
                                    uint32_t below_u,
                                    uint32_t below_v,
                                    double *out);

/**
 * Points and derivatives of a surface on a grid, faster than one by one.
 *
 * u, v: [count_u] and [count_v] parameters, finite. Outside the domain the end spans are continued.
 * order: highest total order of derivatives, 0 to 2.
 * out: [count_u][count_v][(order + 1) * (order + 2) / 2][3]: as bladesmith_surface_evaluate(), v
 * fastest.
 * Units: mm, and mm per parameter to the power of the order.
 * Owner: the caller gives the arrays; out is written only on success.
 * Errors: BLADESMITH_STATUS_ARGUMENT.
 */
int32_t bladesmith_surface_evaluate_grid(const bladesmith_surface *surface,
                                         const double *u,
                                         size_t count_u,
                                         const double *v,
                                         size_t count_v,
                                         uint32_t order,
                                         double *out);

/**
 * Normals and principal curvatures of a surface. Any of the outputs may be NULL; where the surface
 * has no normal all are NaN.
 *
 * uv: [count][2] parameters, finite.
 * normals: [count][3] unit normals along S_u x S_v.
 * curvatures: [count][2] the smaller and the larger principal curvature, positive where the surface
 * bends towards the normal.
 * directions: [count][2][3] unit tangents along which they hold; at an umbilic any two.
 * Units: curvatures 1/mm.
 * Owner: the caller gives the arrays; written only on success.
 * Errors: BLADESMITH_STATUS_ARGUMENT.
 */
int32_t bladesmith_surface_curvatures(const bladesmith_surface *surface,
                                      const double *uv,
                                      size_t count,
                                      double *normals,
                                      double *curvatures,
                                      double *directions);

/**
 * Frees a surface; NULL is fine. No call may be using it.
 *
 * Owner: the library again; the handle must not be used any more.
 * Errors: none.
 */
void bladesmith_surface_free(bladesmith_surface *surface);

/**
 * The Bézier patches of a surface, each over the spans it came from, those along v next to each
 * other.
 *
 * Owner: `*out` is the caller's, for bladesmith_surfaces_free(); written only on success.
 * Errors: BLADESMITH_STATUS_ARGUMENT; BLADESMITH_STATUS_SPLINE for surfaces that jump.
 */
int32_t bladesmith_surface_bezier(const bladesmith_surface *surface, bladesmith_surfaces **out);

/**
 * Number of surfaces.
 *
 * Owner: the caller gives the place.
 * Errors: BLADESMITH_STATUS_ARGUMENT.
 */
int32_t bladesmith_surfaces_count(const bladesmith_surfaces *surfaces, size_t *count);

/**
 * One of the surfaces, as a handle of its own.
 *
 * index: from 0.
 * Owner: `*out` is the caller's, for bladesmith_surface_free(); written only on success.
 * Errors: BLADESMITH_STATUS_ARGUMENT, also for an index that is not there.
 */
int32_t bladesmith_surfaces_get(const bladesmith_surfaces *surfaces,
                                size_t index,
                                bladesmith_surface **out);

/**
 * Frees the list; NULL is fine. Surfaces taken from it stay. No call may be using it.
 *
 * Owner: the library again; the handle must not be used any more.
 * Errors: none.
 */
void bladesmith_surfaces_free(bladesmith_surfaces *surfaces);

/**
 * The same surface with knots inserted along a direction, as bladesmith_curve_refine().
 *
 * direction: 0 for u, 1 for v.
 * knots: [count] in the inside of the domain, not decreasing.
 * Units: those of the parameter.
 * Owner: `*out` is the caller's, for bladesmith_surface_free(); written only on success.
 * Errors: BLADESMITH_STATUS_ARGUMENT; BLADESMITH_STATUS_SPLINE where a knot lies elsewhere or would
 * stand more often than the degree.
 */
int32_t bladesmith_surface_refine(const bladesmith_surface *surface,
                                  uint32_t direction,
                                  const double *knots,
                                  size_t count,
                                  bladesmith_surface **out);

/**
 * The surface with a knot along a direction removed as often as the surface moves by no more than a
 * tolerance in all, as bladesmith_curve_remove_knot().
 *
 * direction: 0 for u, 1 for v.
 * t: the knot, exactly.
 * times: how often it shall be removed, at most as often as it stands there.
 * tolerance: not negative.
 * moved: [1] is set to a bound of the movement; may be NULL.
 * Units: tolerance and moved mm.
 * Owner: `*out` is the caller's, for bladesmith_surface_free(); written only on success.
 * Errors: BLADESMITH_STATUS_ARGUMENT; BLADESMITH_STATUS_SPLINE for a knot that does not stand
 * there so often.
 */
int32_t bladesmith_surface_remove_knot(const bladesmith_surface *surface,
                                       uint32_t direction,
                                       double t,
                                       uint32_t times,
                                       double tolerance,
                                       double *moved,
                                       bladesmith_surface **out);

/**
 * The same surface, clamped, with its degree along a direction raised.
 *
 * direction: 0 for u, 1 for v.
 * by: by how much; the new degree is at most 25.
 * Owner: `*out` is the caller's, for bladesmith_surface_free(); written only on success.
 * Errors: BLADESMITH_STATUS_ARGUMENT; BLADESMITH_STATUS_SPLINE beyond the highest degree and for
 * surfaces that jump.
 */
int32_t bladesmith_surface_elevate(const bladesmith_surface *surface,
                                   uint32_t direction,
                                   uint32_t by,
                                   bladesmith_surface **out);

/**
 * A surface of a degree lower by one along a direction that is, at equal parameters, no further
 * away than a tolerance.
 *
 * direction: 0 for u, 1 for v.
 * tolerance: not negative.
 * moved: [1] is set to a bound of the distance; may be NULL.
 * Units: mm.
 * Owner: `*out` is the caller's, for bladesmith_surface_free(); written only on success.
 * Errors: BLADESMITH_STATUS_ARGUMENT; BLADESMITH_STATUS_NUMERICS where the tolerance cannot be met;
 * BLADESMITH_STATUS_SPLINE for degree 1 and surfaces that jump.
 */
int32_t bladesmith_surface_reduce(const bladesmith_surface *surface,
                                  uint32_t direction,
                                  double tolerance,
                                  double *moved,
                                  bladesmith_surface **out);

/**
 * The part of a surface between two parameters along a direction; two parts split it.
 *
 * direction: 0 for u, 1 for v.
 * from, to: ascending, in the domain.
 * Owner: `*out` is the caller's, for bladesmith_surface_free(); written only on success.
 * Errors: BLADESMITH_STATUS_ARGUMENT; BLADESMITH_STATUS_SPLINE for an empty part or one outside.
 */
int32_t bladesmith_surface_part(const bladesmith_surface *surface,
                                uint32_t direction,
                                double from,
                                double to,
                                bladesmith_surface **out);

/**
 * The surface run backwards along a direction, over the same domain.
 *
 * direction: 0 for u, 1 for v.
 * Owner: `*out` is the caller's, for bladesmith_surface_free(); written only on success.
 * Errors: BLADESMITH_STATUS_ARGUMENT.
 */
int32_t bladesmith_surface_reverse(const bladesmith_surface *surface,
                                   uint32_t direction,
                                   bladesmith_surface **out);

/**
 * The surface with u and v exchanged; its normal turns round.
 *
 * Owner: `*out` is the caller's, for bladesmith_surface_free(); written only on success.
 * Errors: BLADESMITH_STATUS_ARGUMENT.
 */
int32_t bladesmith_surface_swap(const bladesmith_surface *surface, bladesmith_surface **out);

/**
 * The same surface over another domain along a direction.
 *
 * direction: 0 for u, 1 for v.
 * from, to: ascending.
 * Owner: `*out` is the caller's, for bladesmith_surface_free(); written only on success.
 * Errors: BLADESMITH_STATUS_ARGUMENT; BLADESMITH_STATUS_SPLINE for an empty domain.
 */
int32_t bladesmith_surface_over(const bladesmith_surface *surface,
                                uint32_t direction,
                                double from,
                                double to,
                                bladesmith_surface **out);

/**
 * The same surface with the end knots of both directions repeated degree + 1 times.
 *
 * Owner: `*out` is the caller's, for bladesmith_surface_free(); written only on success.
 * Errors: BLADESMITH_STATUS_ARGUMENT; BLADESMITH_STATUS_SPLINE where rounding leaves no such knots.
 */
int32_t bladesmith_surface_clamp(const bladesmith_surface *surface, bladesmith_surface **out);

/**
 * The image of a surface under an affine map, exactly.
 *
 * matrix: [3][4]: row by row, the last column a shift.
 * Units: the shift as the poles.
 * Owner: `*out` is the caller's, for bladesmith_surface_free(); written only on success.
 * Errors: BLADESMITH_STATUS_ARGUMENT; BLADESMITH_STATUS_SPLINE where numbers overflow.
 */
int32_t bladesmith_surface_map(const bladesmith_surface *surface,
                               const double *matrix,
                               bladesmith_surface **out);

/**
 * The curve along which the parameter of a direction stays the same, exactly; it runs over the
 * other parameter.
 *
 * direction: 0 for constant u, 1 for constant v.
 * t: that parameter, in the domain.
 * Owner: `*out` is the caller's, for bladesmith_curve_free(); written only on success.
 * Errors: BLADESMITH_STATUS_ARGUMENT, also for a parameter outside.
 */
int32_t bladesmith_surface_isocurve(const bladesmith_surface *surface,
                                    uint32_t direction,
                                    double t,
                                    bladesmith_curve **out);

/**
 * The surface of the lines between points of two curves at equal parameters: u runs along the
 * curves, v in [0, 1] from the first to the second.
 *
 * Owner: `*out` is the caller's, for bladesmith_surface_free(); written only on success.
 * Errors: BLADESMITH_STATUS_ARGUMENT; BLADESMITH_STATUS_SPLINE for curves that jump.
 */
int32_t bladesmith_surface_ruled(const bladesmith_curve *first,
                                 const bladesmith_curve *second,
                                 bladesmith_surface **out);

/**
 * The surface that a curve sweeps when it turns about an axis, exactly: u runs along the curve, v
 * in [0, 1] with the turn.
 *
 * origin, axis: [3] a point of the axis and its direction, of any length.
 * angle: in rad, counterclockwise seen against the axis; at most a full turn either way.
 * Units: origin mm.
 * Owner: `*out` is the caller's, for bladesmith_surface_free(); written only on success.
 * Errors: BLADESMITH_STATUS_ARGUMENT.
 */
int32_t bladesmith_surface_revolved(const bladesmith_curve *curve,
                                    const double *origin,
                                    const double *axis,
                                    double angle,
                                    bladesmith_surface **out);

/**
 * The bilinearly blended Coons patch between four curves that meet in four corners.
 *
 * curves: [4] along u at the start and the end of v, then along v at the start and the end of u.
 * Domains are those of the first of each pair.
 * Owner: `*out` is the caller's, for bladesmith_surface_free(); written only on success.
 * Errors: BLADESMITH_STATUS_ARGUMENT; BLADESMITH_STATUS_SPLINE for curves that do not meet, and
 * for weights that fall so far below those of the ends that the blend has none above zero.
 */
int32_t bladesmith_surface_coons(const bladesmith_curve *const *curves, bladesmith_surface **out);

/**
 * The surface through sections: u runs along them, v across.
 *
 * sections: [count] curves, more than degree.
 * parameters: [count] ascending values of v at which the surface holds the sections.
 * degree: along v.
 * Units: those of the parameter.
 * Owner: `*out` is the caller's, for bladesmith_surface_free(); written only on success.
 * Errors: BLADESMITH_STATUS_ARGUMENT; BLADESMITH_STATUS_SPLINE where weights are too uneven to be
 * blended.
 */
int32_t bladesmith_surface_skin(const bladesmith_curve *const *sections,
                                const double *parameters,
                                size_t count,
                                uint32_t degree,
                                bladesmith_surface **out);

/**
 * The nearest point of a curve to each of many. The first call on a curve prepares it: later ones
 * are faster. Any of the outputs may be NULL.
 *
 * points: [count][dimension], finite.
 * t: [count] parameters.
 * feet: [count][dimension] the nearest points.
 * distances: [count].
 * Units: mm.
 * Owner: the caller gives the arrays; written only on success.
 * Errors: BLADESMITH_STATUS_ARGUMENT; BLADESMITH_STATUS_SPLINE for curves that jump;
 * BLADESMITH_STATUS_NUMERICS for coordinates beyond 1e150.
 */
int32_t bladesmith_curve_nearest(const bladesmith_curve *curve,
                                 const double *points,
                                 size_t count,
                                 double *t,
                                 double *feet,
                                 double *distances);

/**
 * All points of a curve that are as near to a point as the nearest, nearest first; where a whole
 * stretch is, some of its points.
 *
 * point: [dimension], finite.
 * tie: by how much they may be further away, not negative.
 * out: a table with the columns t, x, y, z (0 in the plane), distance.
 * Units: mm.
 * Owner: `*out` is the caller's, for bladesmith_table_free(); written only on success.
 * Errors: BLADESMITH_STATUS_ARGUMENT; BLADESMITH_STATUS_SPLINE for curves that jump;
 * BLADESMITH_STATUS_NUMERICS for coordinates beyond 1e150.
 */
int32_t bladesmith_curve_nearest_all(const bladesmith_curve *curve,
                                     const double *point,
                                     double tie,
                                     bladesmith_table **out);

/**
 * The nearest point of a surface to each of many. The first call on a surface prepares it: later
 * ones are faster. Any of the outputs may be NULL.
 *
 * points: [count][3], finite.
 * uv: [count][2] parameters.
 * feet: [count][3] the nearest points.
 * distances: [count].
 * Units: mm.
 * Owner: the caller gives the arrays; written only on success.
 * Errors: BLADESMITH_STATUS_ARGUMENT; BLADESMITH_STATUS_SPLINE for surfaces that jump;
 * BLADESMITH_STATUS_NUMERICS for coordinates beyond 1e150.
 */
int32_t bladesmith_surface_nearest(const bladesmith_surface *surface,
                                   const double *points,
                                   size_t count,
                                   double *uv,
                                   double *feet,
                                   double *distances);

/**
 * All points of a surface that are as near to a point as the nearest, nearest first; where a whole
 * curve or area is, some of its points.
 *
 * point: [3], finite.
 * tie: by how much they may be further away, not negative.
 * out: a table with the columns u, v, x, y, z, distance.
 * Units: mm.
 * Owner: `*out` is the caller's, for bladesmith_table_free(); written only on success.
 * Errors: BLADESMITH_STATUS_ARGUMENT; BLADESMITH_STATUS_SPLINE for surfaces that jump;
 * BLADESMITH_STATUS_NUMERICS for coordinates beyond 1e150.
 */
int32_t bladesmith_surface_nearest_all(const bladesmith_surface *surface,
                                       const double *point,
                                       double tie,
                                       bladesmith_table **out);

/**
 * All places where two curves are not further apart than a tolerance, each once: single points, and
 * stretches along which they are one.
 *
 * other: a curve of the same dimension.
 * tolerance: above 0, and small against the curves.
 * crossings: a table with the columns t, s, x, y, z, distance, tangential: parameters on curve and
 * other, the middle between both points (z = 0 in the plane), how far these are apart, and 1 where
 * the curves touch or 0 where they cross; by t. On the seam of a closed curve t is that of its start.
 * overlaps: a table with the columns t0, t1, s0, s1: parameters on curve, ascending, and those on
 * other at the same points. Their ends are not among the crossings.
 * Units: mm.
 * Owner: both tables are the caller's, for bladesmith_table_free(); written only on success.
 * Errors: BLADESMITH_STATUS_ARGUMENT; BLADESMITH_STATUS_NUMERICS for curves that are near to each
 * other in too many places, as with a tolerance in the order of their size.
 */
int32_t bladesmith_curve_intersect(const bladesmith_curve *curve,
                                   const bladesmith_curve *other,
                                   double tolerance,
                                   bladesmith_table **crossings,
                                   bladesmith_table **overlaps);

/**
 * The places that a curve passes twice to within a tolerance, as bladesmith_curve_intersect():
 * s and t are different parameters, the smaller first. The seam of a closed curve and cusps are
 * none.
 *
 * tolerance: above 0, and small against the curve.
 * crossings, overlaps: as there.
 * Units: mm.
 * Owner: both tables are the caller's, for bladesmith_table_free(); written only on success.
 * Errors: as there.
 */
int32_t bladesmith_curve_self_intersect(const bladesmith_curve *curve,
                                        double tolerance,
                                        bladesmith_table **crossings,
                                        bladesmith_table **overlaps);

/**
 * All places where a curve is not further than a tolerance from a ray, the first on the ray first.
 * A stretch that runs along the ray is one of them.
 *
 * origin, direction: [dimension] of the curve; the direction of any length but 0.
 * both: 0: the ray begins at its origin; not 0: it runs to both sides.
 * tolerance: above 0, and small against the curve.
 * out: a table with the columns length, from, to, t, x, y, z, distance, tangential: the length from
 * the origin to the place, the part of the ray within the tolerance (of no length unless it runs
 * along), the parameter and point of the curve (z = 0 in the plane), its distance from the ray, and
 * 1 where the ray touches or runs along, 0 where it crosses.
 * Units: mm.
 * Owner: `*out` is the caller's, for bladesmith_table_free(); written only on success.
 * Errors: BLADESMITH_STATUS_ARGUMENT; BLADESMITH_STATUS_NUMERICS as bladesmith_curve_intersect().
 */
int32_t bladesmith_curve_ray(const bladesmith_curve *curve,
                             const double *origin,
                             const double *direction,
                             uint32_t both,
                             double tolerance,
                             bladesmith_table **out);

/**
 * All places where a surface is not further than a tolerance from a ray, the first on the ray
 * first. A stretch along which the ray grazes the surface or runs on it is one of them.
 *
 * origin, direction: [3]; the direction of any length but 0.
 * both: 0: the ray begins at its origin; not 0: it runs to both sides.
 * tolerance: above 0, and small against the surface.
 * out: a table with the columns length, from, to, u, v, x, y, z, distance, tangential, as
 * bladesmith_curve_ray().
 * Units: mm.
 * Owner: `*out` is the caller's, for bladesmith_table_free(); written only on success.
 * Errors: BLADESMITH_STATUS_ARGUMENT; BLADESMITH_STATUS_SPLINE for surfaces that jump;
 * BLADESMITH_STATUS_NUMERICS for a tolerance in the order of the surface's size.
 */
int32_t bladesmith_surface_ray(const bladesmith_surface *surface,
                               const double *origin,
                               const double *direction,
                               uint32_t both,
                               double tolerance,
                               bladesmith_table **out);

/**
 * Where each of many rays first comes nearer to a curve than a tolerance, as the first row of
 * bladesmith_curve_ray(). Any of the outputs may be NULL; where a ray misses the curve all are NaN.
 *
 * origins, directions: [count][dimension] of the curve; directions of any length but 0.
 * tolerance: above 0, and small against the curve.
 * lengths: [count] from the origins.
 * t: [count] parameters.
 * points: [count][dimension] of the curve.
 * Units: mm.
 * Owner: the caller gives the arrays; written only on success.
 * Errors: as there.
 */
int32_t bladesmith_curve_first_hits(const bladesmith_curve *curve,
                                    const double *origins,
                                    const double *directions,
                                    size_t count,
                                    double tolerance,
                                    double *lengths,
                                    double *t,
                                    double *points);

/**
 * Where each of many rays first comes nearer to a surface than a tolerance, as the first row of
 * bladesmith_surface_ray(). The first call on a surface prepares it: later ones are faster. Any of
 * the outputs may be NULL; where a ray misses the surface all are NaN.
 *
 * origins, directions: [count][3]; directions of any length but 0.
 * tolerance: above 0, and small against the surface.
 * lengths: [count] from the origins.
 * uv: [count][2] parameters.
 * points: [count][3] of the surface.
 * Units: mm.
 * Owner: the caller gives the arrays; written only on success.
 * Errors: as there.
 */
int32_t bladesmith_surface_first_hits(const bladesmith_surface *surface,
                                      const double *origins,
                                      const double *directions,
                                      size_t count,
                                      double tolerance,
                                      double *lengths,
                                      double *uv,
                                      double *points);

/**
 * The points at a distance from a curve in the plane, on one side of it, that are nowhere nearer to
 * it, as curves that run as it does: several, one, or none where nothing is left.
 *
 * distance: positive to the left of the curve; not 0.
 * tolerance: how far curves may be from the true offset; above 0 and below the distance.
 * limit: 0: arcs go around outward corners; at least 1: straight lines go on until they meet, where
 * the tip is not further from the corner than limit times the distance.
 * pieces: a table with the columns curve, from, to, source_from, source_to: the smooth pieces of
 * all curves in order, each with the index of its curve, its parameters there, and those on the
 * source, which are one at a corner.
 * Units: mm.
 * Owner: `*curves` is the caller's, for bladesmith_curves_free(), and `*pieces`, for
 * bladesmith_table_free(); written only on success.
 * Errors: BLADESMITH_STATUS_ARGUMENT, also for a curve in space; BLADESMITH_STATUS_SPLINE for curves
 * that jump; BLADESMITH_STATUS_NUMERICS for curves that stand still.
 */
int32_t bladesmith_curve_offset(const bladesmith_curve *curve,
                                double distance,
                                double tolerance,
                                double limit,
                                bladesmith_curves **curves,
                                bladesmith_table **pieces);

/**
 * The whole offset of a curve in the plane, loops and all: nothing is trimmed, but curves end at
 * inward corners.
 *
 * distance, tolerance, limit, curves, pieces: as bladesmith_curve_offset() [1].
 * Units: mm.
 * Owner: as there; written only on success.
 * Errors: as there.
 */
int32_t bladesmith_curve_offset_raw(const bladesmith_curve *curve,
                                    double distance,
                                    double tolerance,
                                    double limit,
                                    bladesmith_curves **curves,
                                    bladesmith_table **pieces);

/**
 * Parameters of a curve mapped to those that have a point in its offset: each part that is kept
 * takes the domain up to the middle of the gaps beside it, evenly.
 *
 * pieces: [piece_count][5] the rows of the table of bladesmith_curve_offset() for this curve, at
 * least one.
 * t: [count] parameters of the curve, finite; beyond the domain as its ends.
 * out: [count] parameters of the curve.
 * Units: those of the parameter.
 * Owner: the caller gives the arrays; out is written only on success.
 * Errors: BLADESMITH_STATUS_ARGUMENT, also for pieces that leave the curve's domain, and where nothing is
 * kept.
 */
int32_t bladesmith_curve_offset_map(const bladesmith_curve *curve,
                                    const double *pieces,
                                    size_t piece_count,
                                    const double *t,
                                    size_t count,
                                    double *out);

/**
 * The surface at a distance along the normals S_u x S_v, over the same domain.
 *
 * distance: negative for the other side.
 * tolerance: how far the result may be from the true offset at equal parameters; above 0.
 * deviation: [1] is set to how far it was seen to be; may be NULL.
 * Units: mm.
 * Owner: `*out` is the caller's, for bladesmith_surface_free(); written only on success.
 * Errors: BLADESMITH_STATUS_ARGUMENT, also where the offset would fold; BLADESMITH_STATUS_SPLINE for
 * surfaces with a kink; BLADESMITH_STATUS_NUMERICS where there is no normal, and where the tolerance
 * cannot be met.
 */
int32_t bladesmith_surface_offset(const bladesmith_surface *surface,
                                  double distance,
                                  double tolerance,
                                  double *deviation,
                                  bladesmith_surface **out);

/**
 * All circular arcs of a radius that are tangent to two curves in the plane, on either side of
 * each, whose circle cuts into neither of them.
 *
 * other: another curve in the plane.
 * tolerance: by how much a circle may cut in; above 0 and below the radius.
 * curves: what the table names.
 * fillets: a table with the columns x, y, t, s, side, other_side, angle, first, arc, second: the
 * centre; the parameters of the points of contact on curve and other; 1 where the centre is to the
 * left of each and -1 to the right; the angle of the arc from curve to other, positive to the left;
 * and the indices in curves of what is left of curve, of the arc, and of what is left of other, or
 * -1 where nothing is. All of them run over [0, 1], curve and other as before.
 * Units: mm; angle rad.
 * Owner: `*curves` is the caller's, for bladesmith_curves_free(), and `*fillets`, for
 * bladesmith_table_free(); written only on success.
 * Errors: BLADESMITH_STATUS_ARGUMENT, also for curves in space; BLADESMITH_STATUS_SPLINE for curves
 * that jump; BLADESMITH_STATUS_NUMERICS for curves that stand still.
 */
int32_t bladesmith_curve_fillets(const bladesmith_curve *curve,
                                 const bladesmith_curve *other,
                                 double radius,
                                 double tolerance,
                                 bladesmith_curves **curves,
                                 bladesmith_table **fillets);

/**
 * One fillet of those of bladesmith_curve_fillets(), or none where there is none that fits.
 *
 * near: [2] where its centre shall be nearest to; or NULL for the one that rounds the corner at
 * which an end of curve meets an end of other.
 * curves, fillets: as there, with one row or none.
 * Units: mm; angle rad.
 * Owner: `*curves` is the caller's, for bladesmith_curves_free(), and `*fillets`, for
 * bladesmith_table_free(); written only on success.
 * Errors: as there; BLADESMITH_STATUS_ARGUMENT also where no ends meet and near is NULL.
 */
int32_t bladesmith_curve_fillet(const bladesmith_curve *curve,
                                const bladesmith_curve *other,
                                double radius,
                                double tolerance,
                                const double *near,
                                bladesmith_curves **curves,
                                bladesmith_table **fillets);

/**
 * The intersection of a surface with a plane.
 *
 * origin, normal: [3] a point of the plane and its direction, of any length but 0.
 * tolerance: how far results may be from both; above 0.
 * Units: mm.
 * Owner: `*out` is the caller's, for bladesmith_section_free(); written only on success.
 * Errors: BLADESMITH_STATUS_ARGUMENT, also for a tolerance below what rounding allows;
 * BLADESMITH_STATUS_SPLINE for surfaces that jump; BLADESMITH_STATUS_NUMERICS where they meet in too
 * many places to follow.
 */
int32_t bladesmith_surface_section(const bladesmith_surface *surface,
                                   const double *origin,
                                   const double *normal,
                                   double tolerance,
                                   bladesmith_section **out);

/**
 * The intersection of two surfaces.
 *
 * other: another surface.
 * tolerance: how far results may be from both; above 0.
 * Units: mm.
 * Owner: `*out` is the caller's, for bladesmith_section_free(); written only on success.
 * Errors: as bladesmith_surface_section().
 */
int32_t bladesmith_surface_intersect(const bladesmith_surface *surface,
                                     const bladesmith_surface *other,
                                     double tolerance,
                                     bladesmith_section **out);

/**
 * The curves of an intersection: branches that end at borders, seams and places where others cross.
 *
 * curves: each branch in space, over its length.
 * first, second: its parameters on the surface, and on the other surface or the plane, as curves in
 * the plane over the same parameter; in a plane as bladesmith_section_axes() tells.
 * branches: a table with the columns closed, touching, deviation: 1 or 0 whether the end is the
 * start, and whether the surfaces touch along it rather than cross; and how far curves and
 * parameters were seen to be from the true branch.
 * Units: mm.
 * Owner: the three lists are the caller's, for bladesmith_curves_free(), and the table, for
 * bladesmith_table_free(); written only on success.
 * Errors: BLADESMITH_STATUS_ARGUMENT.
 */
int32_t bladesmith_section_branches(const bladesmith_section *section,
                                    bladesmith_curves **curves,
                                    bladesmith_curves **first,
                                    bladesmith_curves **second,
                                    bladesmith_table **branches);

/**
 * What else an intersection holds.
 *
 * touching: a table with the columns x, y, z, u, v, s, t, gap, crossing of points in which the
 * tangent planes agree: (u, v) on the surface, (s, t) on the other or the plane, how far both are
 * apart, and 1 where two branches cross there or 0 where it is a single point.
 * overlaps: a table with the columns u0, v0, u1, v1: corners of rectangles of the surface's
 * parameters over which both are one.
 * uncertain: a table with the columns u, v: parameters of the surface around which the contact is
 * too close to decide, or where a branch could not be followed to its end.
 * Units: mm.
 * Owner: the tables are the caller's, for bladesmith_table_free(); written only on success.
 * Errors: BLADESMITH_STATUS_ARGUMENT.
 */
int32_t bladesmith_section_contacts(const bladesmith_section *section,
                                    bladesmith_table **touching,
                                    bladesmith_table **overlaps,
                                    bladesmith_table **uncertain);

/**
 * The axes to which parameters on the plane of an intersection refer.
 *
 * out: [3][3] the origin and two unit vectors: (s, t) is the point origin + s x + t y.
 * Units: origin mm.
 * Owner: the caller gives the array; written only on success.
 * Errors: BLADESMITH_STATUS_ARGUMENT, also for an intersection of two surfaces.
 */
int32_t bladesmith_section_axes(const bladesmith_section *section, double *out);

/**
 * Frees an intersection; NULL is fine. Lists and tables taken from it stay. No call may be using it.
 *
 * Owner: the library again; the handle must not be used any more.
 * Errors: none.
 */
void bladesmith_section_free(bladesmith_section *section);

/**
 * A curve in space projected onto a surface: to the nearest points, or along a direction.
 *
 * direction: [3] of any length but 0: all points of the surface on lines along it through the curve,
 * each part over its length. Or NULL: the nearest points where they are the feet of perpendiculars,
 * over the parameter of the curve; one part for each stretch over which they move without leap.
 * tolerance: how far parts may be from the true projection; above 0.
 * curves: the parts in space.
 * parameters: their parameters on the surface, as curves in the plane over the same parameter.
 * deviations: a table with the column deviation: how far each was seen to be.
 * Units: mm.
 * Owner: both lists are the caller's, for bladesmith_curves_free(), and the table, for
 * bladesmith_table_free(); written only on success.
 * Errors: BLADESMITH_STATUS_ARGUMENT, also for a curve in the plane or along the direction;
 * BLADESMITH_STATUS_SPLINE for shapes that jump; BLADESMITH_STATUS_NUMERICS where the tolerance is not
 * met, or lines touch the surface too closely.
 */
int32_t bladesmith_surface_project(const bladesmith_surface *surface,
                                   const bladesmith_curve *curve,
                                   const double *direction,
                                   double tolerance,
                                   bladesmith_curves **curves,
                                   bladesmith_curves **parameters,
                                   bladesmith_table **deviations);

#ifdef __cplusplus
}  // extern "C"
#endif  // __cplusplus

#endif  /* BLADESMITH_H */
