/* Writes the folded deck: the text of the flat one with other nodes and the flat ones as reference. */
#include <ctype.h>
#include <errno.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>

#include "fold/fold.h"
#include "io/deck_file.h"
#include "solver/memory.h"

bool fold_is_keyword(const char *line, const char *name)
{
    const size_t length = strlen(name);
    return strncasecmp(line, name, length) == 0 && !isalnum((unsigned char)line[length]) && line[length] != '_';
}

static void write_nodes(FILE *stream, const Definitions *definitions, const FoldBag *bag, const int *place)
{
    fprintf(stream, "*NODE\n");
    for (size_t i = 0; i < definitions->nodes.count; i++) {
        const NodeDefinition *node = &definitions->nodes.items[i];
        const double *x = place[i] >= 0 ? bag->x + 3 * (ptrdiff_t)place[i] : node->x;
        fprintf(stream, "%d,%.15g,%.15g,%.15g", node->id, x[0], x[1], x[2]);
        if (node->tc || node->rc) fprintf(stream, ",%d,%d", node->tc, node->rc);
        fputc('\n', stream);
    }
}

static void write_reference(FILE *stream, const FoldBag *bag, const int *node_id)
{
    fprintf(stream, "$ the flat bag, which has no stress\n*AIRBAG_REFERENCE_GEOMETRY\n");
    for (int n = 0; n < bag->node_count; n++) {
        const double *x = bag->flat + 3 * (ptrdiff_t)n;
        fprintf(stream, "%d,%.15g,%.15g,%.15g\n", node_id[n], x[0], x[1], x[2]);
    }
}

/* The deck without its *NODE blocks, up to *END. */
static void copy_rest(FILE *stream, const char *text)
{
    bool skip = false;
    for (const char *line = text; *line;) {
        const char *next = strchr(line, '\n');
        const size_t length = next ? (size_t)(next - line) + 1 : strlen(line);
        if (*line == '*') skip = fold_is_keyword(line, "*NODE");
        if (fold_is_keyword(line, "*END")) break;
        if (!skip) fwrite(line, 1, length, stream);
        if (!next && !skip) fputc('\n', stream);
        line += length;
    }
}

static int *places_of(const Definitions *definitions, const FoldBag *bag, const int *node_id)
{
    int *place = memory_alloc(definitions->nodes.count + 1, sizeof *place);
    if (!place) return NULL;
    /* both in the order of the definitions */
    int n = 0;
    for (size_t i = 0; i < definitions->nodes.count; i++)
        place[i] = n < bag->node_count && node_id[n] == definitions->nodes.items[i].id ? n++ : -1;
    return place;
}

int fold_write_deck(const char *deck, const char *output, const Definitions *definitions, const FoldBag *bag,
                    const int *node_id, char problem[FOLD_TEXT])
{
    DeckFile file = {0};
    bool no_memory;
    const char *wrong = deck_file_read(deck, &file, &no_memory);
    int *place = wrong ? NULL : places_of(definitions, bag, node_id);
    if (!wrong && !place) wrong = "not enough memory";
    FILE *stream = wrong ? NULL : fopen(output, "wb");
    if (!wrong && !stream) wrong = strerror(errno);
    if (stream) {
        copy_rest(stream, file.text);
        write_reference(stream, bag, node_id);
        write_nodes(stream, definitions, bag, place);
        fprintf(stream, "*END\n");
        const bool failed = ferror(stream) != 0;
        if (fclose(stream) || failed) wrong = "cannot be written to its end";
    }
    memory_free(file.text);
    memory_free(place);
    if (!wrong) return 0;
    snprintf(problem, FOLD_TEXT, "%s: %s", output, wrong);
    return -1;
}
