/* Rubber membranes: the constants of *MAT_MOONEY-RIVLIN_RUBBER and *MAT_OGDEN_RUBBER -> RubberLaw. */
#include "solver/builder.h"

static void report(Builder *b, const MaterialDefinition *m, bool first_use, const char *what)
{
    if (first_use)
        diagnostics_add(b->diagnostics, SEVERITY_ERROR, m->source, m->keyword, "material %d: %s", m->id, what);
}

/* Terms that are there; -1 if one cannot be. */
static int take_terms(Builder *b, const MaterialDefinition *m, bool first_use, RubberLaw *law)
{
    int status = 0;
    for (int i = 0; i < RUBBER_TERMS; i++) {
        double mu = m->rubber.mu[i], alpha = m->rubber.alpha[i];
        if (mu == 0.0 && alpha == 0.0) continue;
        if (!(mu * alpha > 0.0)) {
            if (first_use)
                diagnostics_add(
                    b->diagnostics, SEVERITY_ERROR, m->source, m->keyword,
                    "material %d: MU%d = %g and ALPHA%d = %g must have the same sign, so that the term has an "
                    "energy of its own",
                    m->id, i + 1, mu, i + 1, alpha);
            status = -1;
            continue;
        }
        law->mu[law->terms] = mu;
        law->alpha[law->terms++] = alpha;
    }
    if (!status && law->terms == 0) {
        report(b, m, first_use, "MU and ALPHA are all zero; billow does not fit them to a test");
        status = -1;
    }
    return status;
}

int rubber_law(Builder *b, const MaterialDefinition *m, bool first_use, PartRecord *part)
{
    RubberLaw *law = builder_alloc(b, 1, sizeof *law);
    if (!law) return -1;
    int status = 0;
    if (!(m->pr >= 0.49 && m->pr <= 0.5)) {
        report(b, m, first_use, "PR must lie between 0.49 and 0.5: billow's rubber is incompressible");
        status = -1;
    }
    if (m->rubber.is_ogden) {
        if (take_terms(b, m, first_use, law)) status = -1;
    } else {
        law->a = m->rubber.a;
        law->b = m->rubber.b;
        if (law->a < 0.0 || law->b < 0.0 || !(law->a + law->b > 0.0)) {
            report(b, m, first_use,
                   law->a == 0.0 && law->b == 0.0
                       ? "A and B are zero; billow does not fit them to a test, give one of them"
                       : "A and B must not be negative");
            status = -1;
        }
    }
    if (status) return -1;
    law_rubber_moduli(law, &part->fabric);
    part->fabric.rubber = law;
    part->law = LAW_RUBBER;
    return 0;
}
