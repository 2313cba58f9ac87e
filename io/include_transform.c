/* The effect of *INCLUDE_TRANSFORM on values: id offsets, unit factors, and the composition of nested transforms. */
#include "io/include_transform.h"

#include <limits.h>
#include <string.h>

IncludeTransform include_transform_identity(void)
{
    return (IncludeTransform){
        .fctmas = 1, .fcttim = 1, .fctlen = 1, .fcttem = 1, .matrix = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0}};
}

static int id_offset(const IncludeTransform *t, FieldScale scale)
{
    switch (scale) {
    case SCALE_ID_NODE:
        return t->idnoff;
    case SCALE_ID_ELEMENT:
        return t->ideoff;
    case SCALE_ID_PART:
        return t->idpoff;
    case SCALE_ID_MATERIAL:
        return t->idmoff;
    case SCALE_ID_SET:
        return t->idsoff;
    case SCALE_ID_FUNCTION:
        return t->idfoff;
    case SCALE_ID_DEFINE:
        return t->iddoff;
    case SCALE_ID_OTHER:
        return t->idroff;
    default:
        return 0;
    }
}

/* The factor of a unit; 0 for what has none (ids, temperatures). */
static double unit_factor(const IncludeTransform *t, FieldScale scale)
{
    double mass = t->fctmas, length = t->fctlen, time = t->fcttim;
    switch (scale) {
    case SCALE_NONE:
        return 1;
    case SCALE_LENGTH:
        return length;
    case SCALE_TIME:
        return time;
    case SCALE_MASS:
        return mass;
    case SCALE_DENSITY:
        return mass / (length * length * length);
    case SCALE_PRESSURE:
        return mass / (length * time * time);
    case SCALE_VELOCITY:
        return length / time;
    case SCALE_ACCELERATION:
        return length / (time * time);
    case SCALE_FORCE:
        return mass * length / (time * time);
    case SCALE_AREA:
        return length * length;
    case SCALE_VOLUME:
        return length * length * length;
    case SCALE_RATE:
        return 1 / time;
    case SCALE_MASS_FLOW:
        return mass / time;
    default:
        return 0;
    }
}

double include_transform_scale(const IncludeTransform *transform, FieldScale scale, double value)
{
    if (!transform || scale == SCALE_NONE) return value;
    if (scale == SCALE_TEMPERATURE) return transform->fcttem * value + transform->temperature_offset;
    double factor = unit_factor(transform, scale);
    if (factor != 0) return factor * value;
    int offset = id_offset(transform, scale);
    if (value == 0) return 0;
    return value < 0 ? value - offset : value + offset;
}

/* a * b of 3 x 4 affine matrices. */
static void multiply_affine(const double a[12], const double b[12], double product[12])
{
    for (int i = 0; i < 3; i++) {
        for (int j = 0; j < 4; j++) {
            double sum = j == 3 ? a[4 * i + 3] : 0;
            for (int k = 0; k < 3; k++) sum += a[4 * i + k] * b[4 * k + j];
            product[4 * i + j] = sum;
        }
    }
}

/* Sums beyond int stay at its limit: the ids that they would make are refused as too large. */
static void add_offset(int *offset, int more)
{
    if (__builtin_add_overflow(*offset, more, offset)) *offset = more < 0 ? INT_MIN : INT_MAX;
}

IncludeTransform include_transform_compose(const IncludeTransform *outer, const IncludeTransform *inner)
{
    if (!outer) return *inner;
    IncludeTransform t = *inner;
    add_offset(&t.idnoff, outer->idnoff);
    add_offset(&t.ideoff, outer->ideoff);
    add_offset(&t.idpoff, outer->idpoff);
    add_offset(&t.idmoff, outer->idmoff);
    add_offset(&t.idsoff, outer->idsoff);
    add_offset(&t.idfoff, outer->idfoff);
    add_offset(&t.iddoff, outer->iddoff);
    add_offset(&t.idroff, outer->idroff);
    t.fctmas *= outer->fctmas;
    t.fcttim *= outer->fcttim;
    t.fctlen *= outer->fctlen;
    t.temperature_offset = outer->fcttem * inner->temperature_offset + outer->temperature_offset;
    t.fcttem *= outer->fcttem;
    /* outer(f (inner x)) with the outer length factor f moved to the coordinates: only inner's translation sees it. */
    double scaled[12];
    memcpy(scaled, inner->matrix, sizeof scaled);
    for (int i = 0; i < 3; i++) scaled[4 * i + 3] *= outer->fctlen;
    multiply_affine(outer->matrix, scaled, t.matrix);
    return t;
}

void include_transform_direction(const IncludeTransform *transform, double x[3])
{
    if (!transform) return;
    const double *m = transform->matrix;
    const double y[3] = {x[0], x[1], x[2]};
    for (int i = 0; i < 3; i++) x[i] = m[4 * i] * y[0] + m[4 * i + 1] * y[1] + m[4 * i + 2] * y[2];
}

void include_transform_point(const IncludeTransform *transform, double x[3])
{
    if (!transform) return;
    include_transform_direction(transform, x);
    for (int i = 0; i < 3; i++) x[i] += transform->matrix[4 * i + 3];
}
