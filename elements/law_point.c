/* One point on the first lane of the smallest packs. */
#define BILLOW_KERNEL_LEVEL 2
#include "elements/law_point.h"

#include "elements/kernel_further.h"

/* A point's constants for the stages, every lane alike. */
typedef struct PointConstants {
    double point[GEOMETRY_POINT_SIZE * BILLOW_LANES] __attribute__((aligned(64)));
    double tail[GEOMETRY_TAIL_SIZE * BILLOW_LANES] __attribute__((aligned(64)));
    double memory[MEMORY_POINT_SIZE * BILLOW_LANES] __attribute__((aligned(64)));
} PointConstants;

static void spread(double *to, int quantity, double value)
{
    for (int l = 0; l < PACK_WIDTH; l++) to[quantity * BILLOW_LANES + l] = value;
}

static PackTensor own_strain(LawKind kind, PackTensor c)
{
    if (kind == LAW_LOGARITHMIC) return logarithmic_state(c).strain;
    if (kind != LAW_BIOT) return green_strain(c);
    PackTensor u = biot_state(c).stretch;
    return (PackTensor){u.a11 - 1.0, u.a22 - 1.0, u.a12};
}

_Static_assert((int)CURVE_MEMORY_SIZE == (int)MEMORY_POINT_SIZE, "what kernels.h says of the memory");

static PackTensor stress_of(LawKind kind, const FabricLaw *law, const LawInput *in, const PointPlace *place,
                            PointPack *p)
{
    int mode = (law->no_compression ? MODE_TENSION_FIELD : 0) | (law->has_liner ? MODE_LINER : 0);
    if (kind == LAW_GREEN) return stress_green(mode, in, place, p);
    if (kind == LAW_LOGARITHMIC) return stress_logarithmic(in, place, p);
    if (kind == LAW_CURVE) return stress_curve(in, place, p);
    if (kind == LAW_RUBBER) return stress_rubber(law->rubber->terms > 0 ? MODE_OGDEN : MODE_MOONEY, in, place, p);
    BiotState state = biot_state(p->c);
    Pack major;
    PackTensor t = biot_stress(law, law->no_compression, law->has_liner, state.stretch, &major);
    return stress_biot(mode, in, place, &state, t, major, p);
}

void law_point(LawKind kind, const FabricLaw *law, const double c[3], double *memory, ptrdiff_t stride,
               double reference_rate, double stress_rate, LawPoint *point)
{
    *point = (LawPoint){0};
    if (kind == LAW_SURFACE) return;
    PointConstants constants = {0};
    LawInput in = {.law = *law};
    if (kind == LAW_GREEN && law->no_compression) in.compliance = make_compliance(&law->fabric);
    spread(constants.point, GEOMETRY_WEIGHT, 1.0);
    spread(constants.tail, GEOMETRY_RATE, reference_rate);
    spread(constants.tail, GEOMETRY_STRESS_RATE, stress_rate);
    int size = memory ? law_memory_size(kind, law) : 0;
    for (int i = 0; i < size; i++) spread(constants.memory, i, memory[i * stride]);
    PointPlace place = {.point = constants.point, .tail = constants.tail, .memory = constants.memory};
    PointPack p = {.c = {pack_of(c[0]), pack_of(c[1]), pack_of(c[2])}};
    PackTensor s = stress_of(kind, law, &in, &place, &p), e = own_strain(kind, p.c);
    for (int i = 0; i < size; i++) memory[i * stride] = constants.memory[i * BILLOW_LANES];
    const double stress[3] = {s.a11[0], s.a22[0], s.a12[0]}, strain[3] = {e.a11[0], e.a22[0], e.a12[0]};
    for (int i = 0; i < 3; i++) {
        point->stress[i] = stress[i];
        point->strain[i] = strain[i];
    }
    point->energy = law_stores_energy(kind, law) ? p.energy[0] : 0.0;
    point->rate = p.rate[0];
}
