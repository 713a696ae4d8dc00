/* Morphs a part by a CalculiX field and prints the report:
 *
 *     morph HOT.brep FIELD.frd FACTOR COLD.brep
 *
 * HOT.brep is Open CASCADE's text B-rep, as FreeCAD's exportBrep writes it. FACTOR 1 adds the
 * displacements, -1 takes them away.
 */
#include <bladesmith/bladesmith.h>
#include <stdio.h>
#include <stdlib.h>

/* Says which call failed and why; what is still owned goes with the program. */
static void need(int32_t status, const char *what)
{
    if (status != BLADESMITH_STATUS_OK) {
        fprintf(stderr, "%s: status %d: %s\n", what, (int)status, bladesmith_last_error());
        exit(EXIT_FAILURE);
    }
}

static char *read_text(const char *path, size_t *length)
{
    FILE *file = fopen(path, "rb");
    char *text = NULL;
    size_t room = 0, got = 0;
    do {
        *length = room > 0 ? *length + got : 0;
        room = *length + 65536;
        text = file ? realloc(text, room) : NULL;
        got = text ? fread(text + *length, 1, room - *length, file) : 0;
    } while (got > 0);
    if (!text || ferror(file)) {
        fprintf(stderr, "%s cannot be read\n", path);
        exit(EXIT_FAILURE);
    }
    fclose(file);
    return text;
}

/* Called during the morph; a return value other than 0 would cancel it. */
static int32_t show(void *user, const char *stage, double fraction)
{
    (void)user;
    fprintf(stderr, "%3.0f %% %s\n", 100.0 * fraction, stage);
    return 0;
}

int main(int argc, char **argv)
{
    if (argc != 5 || bladesmith_abi_version() != BLADESMITH_ABI_VERSION) {
        fprintf(stderr, "usage: morph HOT.brep FIELD.frd FACTOR COLD.brep (Bladesmith %s)\n", bladesmith_version());
        return EXIT_FAILURE;
    }
    size_t length = 0;
    char *text = read_text(argv[1], &length);
    bladesmith_part *hot = NULL, *cold = NULL;
    bladesmith_field *field = NULL;
    bladesmith_morphed *morphed = NULL;
    need(bladesmith_part_read(text, length, argv[1], &hot), "reading the part");
    free(text);
    need(bladesmith_field_read(argv[2], NULL, 0, &field), "reading the field");

    bladesmith_morph_options options;
    bladesmith_morph_options_init(&options, sizeof options);
    options.factor = strtod(argv[3], NULL);
    options.solid_name = argv[1];
    need(bladesmith_morph(hot, field, &options, show, NULL, &morphed), "morphing");
    bladesmith_part_free(hot);
    bladesmith_field_free(field);

    /* Texts are asked for their length first, then fetched with room for the NUL. */
    need(bladesmith_morphed_report(morphed, NULL, 0, &length), "the report");
    text = malloc(length + 1);
    need(bladesmith_morphed_report(morphed, text, length + 1, &length), "the report");
    puts(text);
    free(text);

    need(bladesmith_morphed_part(morphed, &cold), "the new part");
    bladesmith_morphed_free(morphed);
    need(bladesmith_part_write(cold, NULL, 0, &length), "writing the part");
    text = malloc(length + 1);
    need(bladesmith_part_write(cold, text, length + 1, &length), "writing the part");
    bladesmith_part_free(cold);
    FILE *file = fopen(argv[4], "wb");
    int written = file && fwrite(text, 1, length, file) == length;
    written = file && fclose(file) == 0 && written;
    free(text);
    if (!written)
        fprintf(stderr, "%s cannot be written\n", argv[4]);
    return written ? EXIT_SUCCESS : EXIT_FAILURE;
}
