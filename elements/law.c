/* Plane-stress moduli from the material cards (docs/theory.md, Fabric). */
#include "elements/law.h"

#include <math.h>

#include "elements/kernels.h"

static PlaneModuli scale_moduli(PlaneModuli d, double share)
{
    PlaneModuli s = {share * d.d11, share * d.d12, share * d.d22, share * d.d33};
    return s;
}

static PlaneModuli add_moduli(PlaneModuli a, PlaneModuli b)
{
    PlaneModuli s = {a.d11 + b.d11, a.d12 + b.d12, a.d22 + b.d22, a.d33 + b.d33};
    return s;
}

PlaneModuli law_isotropic(double e, double nu)
{
    double q = e / (1.0 - nu * nu);
    PlaneModuli d = {q, nu * q, q, 0.5 * e / (1.0 + nu)};
    return d;
}

PlaneModuli law_orthotropic(double ea, double eb, double nu_ba, double nu_ab, double g)
{
    double det = 1.0 - nu_ba * nu_ab;
    PlaneModuli d = {ea / det, 0.5 * (nu_ba * ea + nu_ab * eb) / det, eb / det, g};
    return d;
}

/* Largest x with det(liner - x whole) = 0 in the block of normal strains, and the ratio of shear moduli. */
static double stiffness_share(const PlaneModuli *part, const PlaneModuli *whole)
{
    double a = whole->d11 * whole->d22 - whole->d12 * whole->d12;
    double b = -(part->d11 * whole->d22 + part->d22 * whole->d11 - 2.0 * part->d12 * whole->d12);
    double c = part->d11 * part->d22 - part->d12 * part->d12;
    double root = b * b - 4.0 * a * c;
    double share = (-b + sqrt(root > 0.0 ? root : 0.0)) / (2.0 * a), shear = part->d33 / whole->d33;
    return share > shear ? share : shear;
}

void law_set(FabricLaw *law, PlaneModuli fabric, PlaneModuli liner, double liner_share, bool has_liner)
{
    law->has_liner = has_liner;
    law->fabric = has_liner ? scale_moduli(fabric, 1.0 - liner_share) : fabric;
    law->liner = has_liner ? scale_moduli(liner, liner_share) : (PlaneModuli){0};
    law->whole = has_liner ? add_moduli(law->fabric, law->liner) : law->fabric;
    law->slack_share = has_liner ? stiffness_share(&law->liner, &law->whole) : 0.0;
}

bool law_stores_energy(LawKind kind, const FabricLaw *law)
{
    return kind == LAW_GREEN || kind == LAW_RUBBER || (kind == LAW_CURVE && !law->has_memory);
}

bool law_keeps_account(LawKind kind, const FabricLaw *law)
{
    if (law->damping > 0.0) return false;
    return kind == LAW_LOGARITHMIC || (kind == LAW_BIOT && law->no_compression);
}

bool law_has_history(LawKind kind, const FabricLaw *law)
{
    if (kind == LAW_SURFACE) return false;
    return !law_stores_energy(kind, law) || law->damping > 0.0;
}

int law_memory_size(LawKind kind, const FabricLaw *law)
{
    return kind == LAW_CURVE && law->has_memory ? MEMORY_POINT_SIZE : 0;
}

void law_rubber_moduli(const RubberLaw *rubber, FabricLaw *law)
{
    double modulus = rubber->terms > 0 ? 0.0 : 2.0 * (rubber->a + rubber->b);
    for (int i = 0; i < rubber->terms; i++) modulus += 0.5 * rubber->mu[i] * rubber->alpha[i];
    law_set(law, law_isotropic(3.0 * modulus, 0.5), (PlaneModuli){0}, 0.0, false);
}
