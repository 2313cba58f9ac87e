/* results.xdmf: each state is written over the closing tags, with new closing tags behind it, in one write. */
#include "io/xdmf.h"

#include <errno.h>
#include <fcntl.h>
#include <inttypes.h>
#include <stdarg.h>
#include <stdbool.h>
#include <stdio.h>
#include <string.h>
#include <unistd.h>

#include "solver/memory.h"

enum { TEXT_SIZE = 8192 }; /* more than one state's XML */

static const char closing_tags[] = "    </Grid>\n  </Domain>\n</Xdmf>\n";

struct Xdmf {
    Diagnostics *diagnostics; /* borrowed */
    char *path, *heavy_name;
    int file;
    off_t end; /* where the closing tags begin */
    XdmfMesh mesh;
    bool reported;
};

typedef struct Text {
    char bytes[TEXT_SIZE];
    size_t length;
} Text;

static void add_text(Text *text, const char *format, ...) __attribute__((format(printf, 2, 3)));

static void add_text(Text *text, const char *format, ...)
{
    va_list arguments;
    va_start(arguments, format);
    int length = vsnprintf(text->bytes + text->length, TEXT_SIZE - text->length, format, arguments);
    va_end(arguments);
    if (length > 0) text->length += (size_t)length;
    if (text->length > TEXT_SIZE) text->length = TEXT_SIZE;
}

static int report_failure(Xdmf *xdmf)
{
    int cause = errno;
    if (!xdmf->reported)
        diagnostics_add(xdmf->diagnostics, SEVERITY_ENVIRONMENT, BILLOW_NO_SOURCE, NULL, "cannot write %s: %s",
                        xdmf->path, cause ? strerror(cause) : "a state's text is too long");
    xdmf->reported = true;
    return -1;
}

/* Writes all bytes at the offset. */
static int write_bytes(int file, const char *bytes, size_t length, off_t offset)
{
    while (length > 0) {
        ssize_t done = pwrite(file, bytes, length, offset);
        if (done < 0 && errno == EINTR) continue;
        if (done <= 0) return -1;
        bytes += done;
        length -= (size_t)done;
        offset += done;
    }
    return 0;
}

/* Replaces the closing tags by text and closing tags; puts the old ones back if that fails. */
static int write_text(Xdmf *xdmf, Text *text)
{
    size_t body = text->length;
    errno = 0;
    add_text(text, "%s", closing_tags);
    if (text->length < TEXT_SIZE && write_bytes(xdmf->file, text->bytes, text->length, xdmf->end) == 0) {
        xdmf->end += (off_t)body;
        return 0;
    }
    report_failure(xdmf);
    if (xdmf->end > 0 && write_bytes(xdmf->file, closing_tags, strlen(closing_tags), xdmf->end) == 0 &&
        ftruncate(xdmf->file, xdmf->end + (off_t)strlen(closing_tags)))
        xdmf->reported = true; /* the tail after the closing tags stays; already reported */
    return -1;
}

int xdmf_create(const char *path, const char *heavy_name, const XdmfMesh *mesh, Xdmf **xdmf, Diagnostics *diagnostics)
{
    Xdmf *created = memory_alloc(1, sizeof *created);
    char *path_copy = memory_alloc(strlen(path) + 1, 1), *heavy_copy = memory_alloc(strlen(heavy_name) + 1, 1);
    *xdmf = NULL;
    if (!created || !path_copy || !heavy_copy) {
        memory_free(created);
        memory_free(path_copy);
        memory_free(heavy_copy);
        diagnostics_add(diagnostics, SEVERITY_ENVIRONMENT, BILLOW_NO_SOURCE, NULL, "not enough memory to write %s",
                        path);
        return -1;
    }
    strcpy(path_copy, path);
    strcpy(heavy_copy, heavy_name);
    *created = (Xdmf){.diagnostics = diagnostics, .path = path_copy, .heavy_name = heavy_copy, .mesh = *mesh};
    Text text = {.length = 0};
    add_text(&text, "<?xml version=\"1.0\" encoding=\"utf-8\"?>\n<Xdmf Version=\"3.0\">\n  <Domain>\n"
                    "    <Grid Name=\"billow\" GridType=\"Collection\" CollectionType=\"Temporal\">\n");
    errno = 0;
    created->file = open(path, O_RDWR | O_CREAT | O_TRUNC | O_CLOEXEC, 0666);
    if (created->file < 0 ? report_failure(created) : write_text(created, &text)) {
        xdmf_close(created);
        return -1;
    }
    *xdmf = created;
    return 0;
}

/* A data item over rows [first, first + rows) of a dataset with total rows; file:path|start:stride:count:dimensions. */
static void add_rows(Text *text, const Xdmf *xdmf, const char *dataset, const char *type, int precision, int components,
                     int64_t first, int64_t rows)
{
    int64_t total = first + rows;
    add_text(text, "<DataItem Format=\"HDF\" NumberType=\"%s\" Precision=\"%d\" Dimensions=\"%" PRId64, type, precision,
             rows);
    if (components > 1) add_text(text, " %d", components);
    add_text(text, "\">%s:%s|", xdmf->heavy_name, dataset);
    if (components > 1)
        add_text(text, "%" PRId64 " 0:1 1:%" PRId64 " %d:%" PRId64 " %d", first, rows, components, total, components);
    else
        add_text(text, "%" PRId64 ":1:%" PRId64 ":%" PRId64, first, rows, total);
    add_text(text, "</DataItem>");
}

typedef struct AttributeLayout {
    const char *name, *dataset, *kind, *type;
    int precision, components;
    bool per_cell, constant;
} AttributeLayout;

/* Six components are a Matrix: as Tensor6, XDMF would take them in another order than VTK. */
static const AttributeLayout attributes[] = {
    {"velocity", "/VTKHDF/PointData/velocity", "Vector", "Float", 8, 3, false, false},
    {"displacement", "/VTKHDF/PointData/displacement", "Vector", "Float", 4, 3, false, false},
    {"node_id", "/VTKHDF/PointData/node_id", "Scalar", "Int", 4, 1, false, true},
    {"stress", "/VTKHDF/CellData/stress", "Matrix", "Float", 4, 6, true, false},
    {"strain", "/VTKHDF/CellData/strain", "Matrix", "Float", 4, 6, true, false},
    {"thickness", "/VTKHDF/CellData/thickness", "Scalar", "Float", 4, 1, true, false},
    {"part_id", "/VTKHDF/CellData/part_id", "Scalar", "Int", 4, 1, true, true},
    {"element_id", "/VTKHDF/CellData/element_id", "Scalar", "Int", 4, 1, true, true},
    {"contact", "/VTKHDF/CellData/contact", "Scalar", "Float", 4, 1, true, false},
    {"eroded", "/VTKHDF/CellData/eroded", "Scalar", "Float", 4, 1, true, false}, /* the last: if XdmfMesh.erodes */
};

static void add_topology(Text *text, const Xdmf *xdmf)
{
    const XdmfMesh *mesh = &xdmf->mesh;
    const char *kind = mesh->corner_count == 3 ? "Triangle" : mesh->corner_count == 4 ? "Quadrilateral" : "Mixed";
    add_text(text, "        <Topology TopologyType=\"%s\" NumberOfElements=\"%" PRId64 "\">", kind, mesh->cell_count);
    if (mesh->corner_count == 0)
        add_text(text,
                 "<DataItem Format=\"HDF\" NumberType=\"Int\" Precision=\"4\" Dimensions=\"%" PRId64
                 "\">%s:/XDMF/Topology</DataItem>",
                 mesh->topology_length, xdmf->heavy_name);
    else
        add_text(text,
                 "<DataItem Format=\"HDF\" NumberType=\"Int\" Precision=\"8\" Dimensions=\"%" PRId64
                 "\">%s:/VTKHDF/Connectivity</DataItem>",
                 mesh->topology_length, xdmf->heavy_name);
    add_text(text, "</Topology>\n");
}

int xdmf_add_state(Xdmf *xdmf, int64_t state, double time)
{
    Text text = {.length = 0};
    const int64_t points = xdmf->mesh.point_count, cells = xdmf->mesh.cell_count;
    add_text(&text, "      <Grid Name=\"state %" PRId64 "\" GridType=\"Uniform\">\n        <Time Value=\"%.17g\"/>\n",
             state, time);
    add_topology(&text, xdmf);
    add_text(&text, "        <Geometry GeometryType=\"XYZ\">");
    add_rows(&text, xdmf, "/VTKHDF/Points", "Float", 8, 3, state * points, points);
    add_text(&text, "</Geometry>\n");
    const size_t count = sizeof attributes / sizeof attributes[0] - (xdmf->mesh.erodes ? 0 : 1);
    for (size_t i = 0; i < count; i++) {
        const AttributeLayout *layout = &attributes[i];
        int64_t rows = layout->per_cell ? cells : points;
        add_text(&text, "        <Attribute Name=\"%s\" AttributeType=\"%s\" Center=\"%s\">", layout->name,
                 layout->kind, layout->per_cell ? "Cell" : "Node");
        add_rows(&text, xdmf, layout->dataset, layout->type, layout->precision, layout->components,
                 layout->constant ? 0 : state * rows, rows);
        add_text(&text, "</Attribute>\n");
    }
    add_text(&text, "      </Grid>\n");
    return write_text(xdmf, &text);
}

int xdmf_close(Xdmf *xdmf)
{
    int status = 0;
    if (!xdmf) return 0;
    errno = 0;
    if (xdmf->file >= 0 && close(xdmf->file)) status = report_failure(xdmf);
    memory_free(xdmf->path);
    memory_free(xdmf->heavy_name);
    memory_free(xdmf);
    return status;
}
