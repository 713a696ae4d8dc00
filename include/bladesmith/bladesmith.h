/**
 * Bladesmith: geometry for turbomachinery blades, the C interface.
 *
 * Main job: morph a CAD solid by a finite-element displacement field, hot to cold or back. Read a
 * part (bladesmith_part_read) and a field (bladesmith_field_read), morph (bladesmith_morph), take
 * the new part and the report (bladesmith_morphed_part, bladesmith_morphed_report).
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

#ifdef __cplusplus
}  // extern "C"
#endif  // __cplusplus

#endif  /* BLADESMITH_H */
