/* *DEFINE_TRANSFORMATION: a sequence of rows, each an affine map applied to the result of those before it. */
#include <limits.h>
#include <math.h>
#include <string.h>
#include <strings.h>

#include "io/deck_loader.h"
#include "io/include_transform.h"
#include "solver/elementary.h"
#include "solver/memory.h"

enum { MOST_POINTS = 1000 }; /* of one transformation */

/* One row: its option and A1 to A7. */
typedef struct TransformRow {
    char option[11];
    double a[7];
} TransformRow;

typedef struct TransformPoint {
    int id;
    double x[3];
} TransformPoint;

/* A transformation being read. */
typedef struct TransformReading {
    DeckLoader *loader;
    const DeckBlock *block;
    Source source; /* of the present row */
    double matrix[12];
    LIST(TransformPoint) points;
} TransformReading;

static int report(const TransformReading *t, const char *option, const char *what)
{
    diagnostics_add(t->loader->diagnostics, SEVERITY_ERROR, t->source, t->block->keyword, "%s: %s", option, what);
    return -1;
}

/* matrix = row * matrix. */
static void append_map(TransformReading *t, const double row[12])
{
    double product[12];
    for (int i = 0; i < 3; i++) {
        for (int j = 0; j < 4; j++) {
            double sum = j == 3 ? row[4 * i + 3] : 0;
            for (int k = 0; k < 3; k++) sum += row[4 * i + k] * t->matrix[4 * k + j];
            product[4 * i + j] = sum;
        }
    }
    memcpy(t->matrix, product, sizeof product);
}

/* The map x -> linear (x - from) + to. */
static void append_linear_map(TransformReading *t, double linear[3][3], const double from[3], const double to[3])
{
    double row[12];
    for (int i = 0; i < 3; i++) {
        row[4 * i + 3] = to[i];
        for (int j = 0; j < 3; j++) {
            row[4 * i + j] = linear[i][j];
            row[4 * i + 3] -= linear[i][j] * from[j];
        }
    }
    append_map(t, row);
}

/* Makes a a unit vector; false if it has no direction. */
static bool normalise(double a[3])
{
    double length = sqrt(a[0] * a[0] + a[1] * a[1] + a[2] * a[2]);
    if (!(length > 0) || !isfinite(length)) return false;
    for (int i = 0; i < 3; i++) a[i] /= length;
    return true;
}

static void set_difference(const double a[3], const double b[3], double difference[3])
{
    for (int i = 0; i < 3; i++) difference[i] = a[i] - b[i];
}

static void set_cross(const double a[3], const double b[3], double cross[3])
{
    cross[0] = a[1] * b[2] - a[2] * b[1];
    cross[1] = a[2] * b[0] - a[0] * b[2];
    cross[2] = a[0] * b[1] - a[1] * b[0];
}

/* Sine and cosine of an angle in degrees, exact for multiples of 90. */
static void turn_angle(double degrees, double *sine, double *cosine)
{
    static const double exact[4] = {0, 1, 0, -1};
    double quarters = degrees / 90;
    if (quarters == floor(quarters) && fabs(quarters) < 1e6) {
        int quarter = (int)quarters & 3;
        *sine = exact[quarter];
        *cosine = exact[(quarter + 1) & 3];
        return;
    }
    double angle = fmod(degrees, 360) * (3.14159265358979323846 / 180);
    *sine = elementary_sin(angle);
    *cosine = elementary_cos(angle);
}

/* Right-handed turn about the axis through the point. */
static int append_rotation(TransformReading *t, const char *option, const double direction[3], const double point[3],
                           double degrees)
{
    double n[3] = {direction[0], direction[1], direction[2]};
    if (!normalise(n)) return report(t, option, "the axis has no direction; two different points must give it");
    double sine, cosine, linear[3][3];
    turn_angle(degrees, &sine, &cosine);
    const double skew[3][3] = {{0, -n[2], n[1]}, {n[2], 0, -n[0]}, {-n[1], n[0], 0}};
    for (int i = 0; i < 3; i++) {
        for (int j = 0; j < 3; j++) {
            linear[i][j] = (i == j ? cosine : 0) + sine * skew[i][j] + (1 - cosine) * n[i] * n[j];
        }
    }
    append_linear_map(t, linear, point, point);
    return 0;
}

static const double *find_point(const TransformReading *t, double id)
{
    for (size_t i = 0; i < t->points.count; i++) {
        if (t->points.items[i].id == id) return t->points.items[i].x;
    }
    return NULL;
}

/* Direction cosines, point and angle; or two POINTs and the angle when A4 to A7 are zero. */
static int append_rotate(TransformReading *t, const TransformRow *row)
{
    const double *a = row->a;
    if (a[3] != 0 || a[4] != 0 || a[5] != 0 || a[6] != 0) return append_rotation(t, row->option, a, a + 3, a[6]);
    const double *from = find_point(t, a[0]), *to = find_point(t, a[1]);
    if (from && to) {
        double axis[3];
        set_difference(to, from, axis);
        return append_rotation(t, row->option, axis, from, a[2]);
    }
    if (t->points.count > 0) return report(t, row->option, "A1 and A2 must be POINTs defined above");
    return 0; /* an angle of zero about any axis: preprocessors write such rows */
}

static int append_mirror(TransformReading *t, const TransformRow *row)
{
    double n[3], linear[3][3];
    set_difference(row->a + 3, row->a, n);
    if (!normalise(n)) return report(t, row->option, "the plane's normal, from (A1, A2, A3) to (A4, A5, A6), is zero");
    for (int i = 0; i < 3; i++) {
        for (int j = 0; j < 3; j++) linear[i][j] = (i == j) - 2 * n[i] * n[j];
    }
    append_linear_map(t, linear, row->a, row->a);
    return 0;
}

static int append_scale(TransformReading *t, const TransformRow *row)
{
    const double origin[3] = {0, 0, 0};
    double linear[3][3] = {{0}};
    for (int i = 0; i < 3; i++) linear[i][i] = row->a[i] == 0 ? 1 : row->a[i];
    append_linear_map(t, linear, origin, origin);
    return 0;
}

static void append_translation(TransformReading *t, const double way[3])
{
    const double map[12] = {1, 0, 0, way[0], 0, 1, 0, way[1], 0, 0, 1, way[2]};
    append_map(t, map);
}

static int define_point(TransformReading *t, const TransformRow *row)
{
    double id = row->a[0];
    if (id != floor(id) || id < 1 || id > INT_MAX) return report(t, row->option, "A1 must be the point's id");
    if (t->points.count >= MOST_POINTS) return report(t, row->option, "a transformation may have 1000 points");
    if (memory_reserve((void **)&t->points.items, &t->points.capacity, t->points.count + 1, sizeof *t->points.items)) {
        loader_report_memory(t->loader);
        return -1;
    }
    TransformPoint point = {(int)id, {row->a[1], row->a[2], row->a[3]}};
    t->points.items[t->points.count++] = point;
    return 0;
}

/* Right-handed axes as rows: the first along x[0]-x[1], the third normal to the three points. */
static bool make_axes(double x[3][3], double axes[3][3])
{
    double side[3];
    set_difference(x[1], x[0], axes[0]);
    set_difference(x[2], x[0], side);
    set_cross(axes[0], side, axes[2]);
    if (!normalise(axes[0]) || !normalise(axes[2])) return false;
    set_cross(axes[2], axes[0], axes[1]);
    return true;
}

/* The rigid motion that brings three start points (x[0..2]) onto three target points (x[3..5]) as far as it can. */
static int append_position(TransformReading *t, const char *option, double x[6][3])
{
    double start[3][3], target[3][3], linear[3][3];
    if (!make_axes(x, start) || !make_axes(x + 3, target)) {
        return report(t, option, "three start or target points lie on one line; they must span a plane");
    }
    for (int i = 0; i < 3; i++) {
        for (int j = 0; j < 3; j++) {
            linear[i][j] = 0;
            for (int k = 0; k < 3; k++) linear[i][j] += target[k][i] * start[k][j];
        }
    }
    append_linear_map(t, linear, x[0], x[3]);
    return 0;
}

/* Coordinates of the nodes A1, A2, ... */
static int find_nodes(TransformReading *t, const TransformRow *row, int count, double x[][3])
{
    for (int i = 0; i < count; i++) {
        double id = row->a[i];
        if (id == floor(id) && id >= 1 && id <= INT_MAX && loader_find_node(t->loader, t->block, (int)id, x[i]))
            continue;
        diagnostics_add(t->loader->diagnostics, SEVERITY_ERROR, t->source, t->block->keyword,
                        "%s: A%d: there is no node %g yet; its *NODE must stand before *DEFINE_TRANSFORMATION",
                        row->option, i + 1, id);
        return -1;
    }
    return 0;
}

/* Rows that name nodes or points. */
static int append_located_row(TransformReading *t, const TransformRow *row)
{
    double x[6][3], way[3];
    const char *option = row->option;
    if (strcasecmp(option, "POS6P") == 0) {
        for (int i = 0; i < 6; i++) {
            const double *point = find_point(t, row->a[i]);
            if (!point) return report(t, option, "A1 to A6 must be POINTs defined above");
            memcpy(x[i], point, sizeof x[i]);
        }
        return append_position(t, option, x);
    }
    if (strcasecmp(option, "POS6N") == 0) return find_nodes(t, row, 6, x) ? -1 : append_position(t, option, x);
    if (strcasecmp(option, "ROTATE3NA") == 0) {
        if (find_nodes(t, row, 3, x)) return -1;
        set_difference(x[1], x[0], way);
        return append_rotation(t, option, way, x[2], row->a[3]);
    }
    if (strcasecmp(option, "TRANSL2ND") == 0) {
        if (find_nodes(t, row, 2, x)) return -1;
        set_difference(x[1], x[0], way);
        if (!normalise(way)) return report(t, option, "the nodes A1 and A2 are at the same place");
        for (int i = 0; i < 3; i++) way[i] *= row->a[2];
        append_translation(t, way);
        return 0;
    }
    return report(
        t, option,
        "unknown option; it must be TRANSL, SCALE, ROTATE, MIRROR, POINT, POS6P, POS6N, TRANSL2ND or ROTATE3NA");
}

static int append_row(TransformReading *t, const TransformRow *row)
{
    if (row->option[0] == '\0') return 0;
    if (strcasecmp(row->option, "TRANSL") == 0) {
        append_translation(t, row->a);
        return 0;
    }
    if (strcasecmp(row->option, "SCALE") == 0) return append_scale(t, row);
    if (strcasecmp(row->option, "ROTATE") == 0) return append_rotate(t, row);
    if (strcasecmp(row->option, "MIRROR") == 0) return append_mirror(t, row);
    if (strcasecmp(row->option, "POINT") == 0) return define_point(t, row);
    return append_located_row(t, row);
}

static void store_transformation(TransformReading *t, int id, Source source)
{
    DeckLoader *loader = t->loader;
    TextStore *store = loader->deck->store;
    Transformation transformation = {.id = (int)include_transform_scale(t->block->transform, SCALE_ID_DEFINE, id),
                                     .source = source};
    memcpy(transformation.matrix, t->matrix, sizeof t->matrix);
    const Transformation *first = loader_find_transformation(loader, transformation.id);
    if (first) {
        diagnostics_add(loader->diagnostics, SEVERITY_ERROR, source, t->block->keyword,
                        "TRANID %d was defined on line %d already; ids must differ", id, first->source.line);
    }
    if (memory_reserve((void **)&store->transformations.items, &store->transformations.capacity,
                       store->transformations.count + 1, sizeof *store->transformations.items)) {
        loader_report_memory(loader);
        return;
    }
    store->transformations.items[store->transformations.count++] = transformation;
}

static void read_transformation(DeckLoader *loader, const DeckBlock *block, bool titled)
{
    static const FieldSpec id_fields[] = {{.name = "TRANID", .type = 'I', .columns = 10, .offset = 0}};
#define A(number, index)                                                                                               \
    {                                                                                                                  \
        .name = "A" number, .type = 'F', .columns = 10, .offset = offsetof(TransformRow, a) + (index) * sizeof(double) \
    }
    static const FieldSpec row_fields[] = {{.name = "OPTION", .type = 'A', .columns = 10, .offset = 0},
                                           A("1", 0),
                                           A("2", 1),
                                           A("3", 2),
                                           A("4", 3),
                                           A("5", 4),
                                           A("6", 5),
                                           A("7", 6)};
#undef A
    CardReader cards = {block, 0, loader->deck->parameters, loader->diagnostics};
    TransformReading t = {.loader = loader, .block = block, .matrix = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0}};
    if (titled) card_skip(&cards);
    int id = 0;
    Source source;
    if (card_read(&cards, id_fields, 1, &id, true, "card 1", &source)) return;
    if (id <= 0) {
        diagnostics_add(loader->diagnostics, SEVERITY_ERROR, source, block->keyword, "TRANID must be positive");
        return;
    }
    while (card_left(&cards)) {
        TransformRow row;
        int count = (int)(sizeof row_fields / sizeof *row_fields);
        if (card_read(&cards, row_fields, count, &row, false, "card 2", &t.source) == 0) append_row(&t, &row);
    }
    /* Stored even after an error in a row: what refers to it is not wrong. */
    store_transformation(&t, id, source);
    memory_free(t.points.items);
}

bool loader_define_transformation(DeckLoader *loader, const DeckBlock *block)
{
    bool titled = strcmp(block->keyword, "*DEFINE_TRANSFORMATION_TITLE") == 0;
    if (!titled && strcmp(block->keyword, "*DEFINE_TRANSFORMATION") != 0) return false;
    read_transformation(loader, block, titled);
    return true;
}

const Transformation *loader_find_transformation(const DeckLoader *loader, int id)
{
    const TextStore *store = loader->deck->store;
    for (size_t i = store->transformations.count; i > 0; i--) {
        if (store->transformations.items[i - 1].id == id) return &store->transformations.items[i - 1];
    }
    return NULL;
}
