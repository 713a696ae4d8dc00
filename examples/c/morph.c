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

/* The result while it is written; it gets its name when it is whole. */
static char partial[FILENAME_MAX];
static FILE *output = NULL;

/* Ends the program; what memory is still owned goes with it. */
static void stop(const char *what, const char *why)
{
    fprintf(stderr, "%s: %s\n", what, why);
    if (output)
        remove(partial);
    exit(EXIT_FAILURE);
}

static void need(int32_t status, const char *what)
{
    if (status != BLADESMITH_STATUS_OK)
        stop(what, bladesmith_last_error());
}

static char *read_text(const char *path, size_t *length)
{
    FILE *file = fopen(path, "rb");
    long size = file && fseek(file, 0, SEEK_END) == 0 ? ftell(file) : -1;
    char *text = size > 0 ? malloc((size_t)size) : NULL;
    if (text)
        rewind(file);
    if (!text || fread(text, 1, (size_t)size, file) != (size_t)size)
        stop(path, "cannot be read");
    fclose(file);
    *length = (size_t)size;
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
    bladesmith_morph_options options;
    char *end = NULL;
    bladesmith_morph_options_init(&options, sizeof options);
    options.solid_name = argv[1];
    options.factor = strtod(argv[3], &end);
    if (end == argv[3] || *end != '\0')
        stop(argv[3], "FACTOR must be a number");
    snprintf(partial, sizeof partial, "%s.partial", argv[4]);
    if ((output = fopen(partial, "wb")) == NULL)
        stop(argv[4], "cannot be written");

    size_t length = 0;
    char *text = read_text(argv[1], &length);
    bladesmith_part *hot = NULL, *cold = NULL;
    bladesmith_field *field = NULL;
    bladesmith_morphed *morphed = NULL;
    need(bladesmith_part_read(text, length, argv[1], &hot), "reading the part");
    free(text);
    need(bladesmith_field_read(argv[2], NULL, 0, &field), "reading the field");
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
    if (fwrite(text, 1, length, output) != length || fclose(output) != 0 || rename(partial, argv[4]) != 0)
        stop(argv[4], "cannot be written");
    free(text);
    return EXIT_SUCCESS;
}
