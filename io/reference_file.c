/* Reference coordinates as a keyword file. */
#include "io/reference_file.h"

#include <errno.h>
#include <limits.h>
#include <stdio.h>
#include <string.h>

#include "solver/memory.h"
#include "solver/reference_table.h"

/* A number in a field of 16 columns with all digits that fit. */
static void write_field(FILE *file, double value)
{
    char text[40];
    for (int digits = 11; digits > 0; digits--)
        if (snprintf(text, sizeof text, "%.*e", digits, value) <= 16) break;
    fprintf(file, "%16s", text);
}

static void write_node(FILE *file, int id, const double x[3])
{
    if (id > 99999999) { /* more than 8 columns: free format */
        fprintf(file, "%d,%.15g,%.15g,%.15g\n", id, x[0], x[1], x[2]);
        return;
    }
    fprintf(file, "%8d", id);
    for (int k = 0; k < 3; k++) write_field(file, x[k]);
    fputc('\n', file);
}

/* The nodes of a block, each once. written: number of the last block that wrote a deck node (node count). */
static void write_block(FILE *file, const ReferenceTable *table, size_t number, size_t *written)
{
    const Definitions *d = table->definitions;
    const ReferenceBlockDefinition *block = &d->reference_blocks.items[number];
    fprintf(file, "$ block %zu of the deck\n*AIRBAG_REFERENCE_GEOMETRY\n", number + 1);
    for (size_t i = block->first; i < block->first + block->count; i++) {
        if (!block->is_shell) {
            write_node(file, d->reference_nodes.items[i].id, table->x + 3 * i);
            continue;
        }
        for (int a = 0; a < 4; a++) {
            int id = d->reference_shells.items[i].node[a];
            int32_t node = id_map_find(&table->nodes, id);
            double x[3];
            if (node < 0 || written[node] == number + 1) continue;
            written[node] = number + 1;
            reference_table_node(table, node, x);
            reference_table_scale(table, block, x);
            write_node(file, id, x);
        }
    }
}

static int write_all(const char *path, const ReferenceTable *table)
{
    const Definitions *d = table->definitions;
    size_t *written = memory_alloc(d->nodes.count + 1, sizeof *written);
    FILE *file = written ? fopen(path, "w") : NULL;
    int status = file ? 0 : -1;
    if (!status) {
        fprintf(file, "*KEYWORD\n");
        for (size_t i = 0; i < d->reference_blocks.count; i++)
            if (d->reference_blocks.items[i].iout == 1) write_block(file, table, i, written);
        fprintf(file, "*END\n");
        if (ferror(file)) status = -1;
        if (fclose(file)) status = -1;
    }
    memory_free(written);
    return status;
}

int reference_file_write(const char *directory, const Definitions *d, Diagnostics *diagnostics)
{
    char path[PATH_MAX];
    bool wanted = false;
    for (size_t i = 0; i < d->reference_blocks.count; i++) wanted |= d->reference_blocks.items[i].iout == 1;
    if (snprintf(path, sizeof path, "%s/%s", directory, BILLOW_REFERENCE_NAME) >= (int)sizeof path) return 0;
    errno = 0;
    if (!wanted) {
        remove(path);
        return 0;
    }
    ReferenceTable table;
    int status = reference_table_build(d, &table);
    if (!status) {
        status = write_all(path, &table);
        reference_table_free(&table);
    }
    if (status)
        diagnostics_add(diagnostics, SEVERITY_ENVIRONMENT, BILLOW_NO_SOURCE, NULL, "cannot write %s: %s", path,
                        errno ? strerror(errno) : "not enough memory");
    return status;
}
