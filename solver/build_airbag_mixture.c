/* *AIRBAG_HYBRID and *AIRBAG_HYBRID_CHEMKIN -> a mixture of gases. */
#include <math.h>
#include <string.h>

#include "solver/build_airbags.h"

static int gas_error(Builder *b, const AirbagGasDefinition *gas, const char *text)
{
    diagnostics_add(b->diagnostics, SEVERITY_ERROR, gas->source, "*AIRBAG", "%s", text);
    return -1;
}

/* Room for the gases; *species and *sources as the model keeps them. */
static int allocate(Builder *b, const AirbagDefinition *bag, GasModel *gas, GasSpecies **species, GasSource **sources)
{
    *species = builder_alloc(b, BILLOW_GAS_SPECIES, sizeof **species);
    *sources = builder_alloc(b, BILLOW_GAS_SPECIES, sizeof **sources);
    if (!*species || !*sources) return -1;
    for (int i = 0; i < BILLOW_GAS_SPECIES; i++)
        (*sources)[i] = (GasSource){.mass_flow_curve = -1, .temperature_curve = -1, .mole_fraction_curve = -1};
    gas->species_count = bag->ngas;
    gas->species = *species;
    gas->sources = *sources;
    return 0;
}

/* What both models have on their cards. */
static int ambient_fields(Builder *b, const AirbagDefinition *bag, GasModel *gas)
{
    int status = 0;
    gas->ambient_temperature = gas->initial_temperature = bag->atmost;
    gas->ambient_pressure = bag->atmosp;
    gas->ambient_density = bag->atmosd;
    gas->gas_constant = bag->gc;
    gas->gravity_conversion = bag->cc != 0.0 ? bag->cc : 1.0;
    if (bag->hconv < 0.0)
        gas->heat_transfer_curve = airbag_curve(b, (int)bag->hconv, "HCONV", bag->card3, &status);
    else
        gas->heat_transfer = bag->hconv;
    if (!(bag->atmost > 0.0) || !(bag->atmosp > 0.0) || !(bag->gc > 0.0))
        status = airbag_error(b, bag->card3,
                              "the atmosphere's temperature and pressure and the gas constant must be positive");
    return status;
}

/* Initial fractions by mass from those of the cards, which are by mole if moles. They should sum to 1. */
static int initial_fractions(Builder *b, const AirbagDefinition *bag, bool moles, const char *field,
                             const double *given, const GasSpecies *species, GasSource *sources)
{
    double sum = 0.0, mass = 0.0;
    for (int i = 0; i < bag->ngas; i++) {
        if (given[i] < 0.0) return gas_error(b, &bag->gases[i], "the initial fraction of a gas must not be negative");
        sum += given[i];
        sources[i].initial_fraction = moles ? given[i] * species[i].molar_mass : given[i];
        mass += sources[i].initial_fraction;
    }
    if (!(mass > 0.0))
        return airbag_error(b, bag->card3, "no gas fills the bag at the start: all initial fractions are 0");
    if (fabs(sum - 1.0) > 1e-3)
        diagnostics_add(b->diagnostics, SEVERITY_WARNING, bag->gases[0].source, "*AIRBAG",
                        "the initial fractions %s sum to %.6g, not to 1; billow divides them by their sum", field, sum);
    for (int i = 0; i < bag->ngas; i++) sources[i].initial_fraction /= mass;
    return 0;
}

/* ATMOSD should be what ATMOSP, ATMOST and the gases of the start make it; where it is 0 that is taken. */
static void check_density(Builder *b, const AirbagDefinition *bag, GasModel *gas)
{
    double r = 0.0;
    for (int i = 0; i < gas->species_count; i++) r += gas->sources[i].initial_fraction * gas->species[i].r;
    double density = bag->atmosp / (r * bag->atmost);
    if (!(gas->ambient_density > 0.0)) gas->ambient_density = density;
    if (bag->atmosd > 0.0 && fabs(bag->atmosd / density - 1.0) > 0.05)
        diagnostics_add(
            b->diagnostics, SEVERITY_WARNING, bag->card3, "*AIRBAG",
            "ATMOSD is %g, but ATMOSP, ATMOST and the gases at the start make the density %g, which the bag "
            "is filled with; check the units of MW and GC",
            bag->atmosd, density);
}

/* One gas of HYBRID: cards 5.1 and 5.2. */
static int hybrid_gas(Builder *b, const AirbagDefinition *bag, int i, GasSpecies *species, GasSource *source)
{
    const AirbagGasDefinition *card = &bag->gases[i];
    int status = 0;
    if (!(card->mw > 0.0)) return gas_error(b, card, "MW must be positive");
    if (card->fmass < 0.0) return gas_error(b, card, "FMASS must not be negative");
    char name[BILLOW_SPECIES_NAME] = "gas ";
    if (i >= 9) name[4] = (char)('0' + (i + 1) / 10);
    name[i >= 9 ? 5 : 4] = (char)('0' + (i + 1) % 10);
    *species = species_make(name, card->mw, bag->gc, (const double[3]){0.0, INFINITY, INFINITY},
                            (const double[2][SPECIES_TERMS]){{card->a, card->b, card->c}});
    if (!(species_cp(species, bag->atmost) > species->r))
        status = gas_error(b, card, "A, B and C must give a heat capacity above GC: A is molar, in the units of GC");
    int flow = airbag_spline(b, card->lcidm, "LCIDM", card->source, &status);
    source->temperature_curve = airbag_spline(b, card->lcidt, "LCIDT", card->source, &status);
    if (bag->lcidm0 != 0)
        source->mole_fraction_curve = flow;
    else
        source->mass_flow_curve = flow;
    if (flow >= 0 && source->temperature_curve < 0 && !status)
        status = gas_error(b, card, "LCIDM is given, so LCIDT must be: the temperature of the gas that flows in");
    source->aspirated = card->fmass;
    return status;
}

int airbag_hybrid(Builder *b, const AirbagDefinition *bag, Airbag *airbag)
{
    GasModel *gas = &airbag->gas;
    GasSpecies *species;
    GasSource *sources;
    gas->kind = GAS_HYBRID;
    int status = ambient_fields(b, bag, gas);
    if (allocate(b, bag, gas, &species, &sources)) return -1;
    double initial[BILLOW_AIRBAG_GASES];
    for (int i = 0; i < bag->ngas; i++) {
        initial[i] = bag->gases[i].initm;
        if (hybrid_gas(b, bag, i, &species[i], &sources[i])) status = -1;
    }
    gas->mass_flow_curve = airbag_spline(b, bag->lcidm0, "LCIDM0", bag->card5, &status);
    gas->total_inflow = bag->lcidm0 != 0;
    gas->exit_flow_curve = airbag_curve(b, bag->lcefr, "LCEFR", bag->card5, &status);
    gas->pop_pressure = bag->ppop;
    if (airbag_vents(b, bag, airbag)) status = -1;
    if (status || initial_fractions(b, bag, bag->lcidm0 != 0, "INITM", initial, species, sources)) return -1;
    check_density(b, bag, gas);
    return 0;
}

/* DATA = 1: the coefficients of the NIST web book, which are for T/1000; the manual writes T. What gives the heat
 * capacity of a gas is taken. */
static int nist_species(Builder *b, const AirbagDefinition *bag, const AirbagGasDefinition *card, GasSpecies *species)
{
    double cp[2][SPECIES_TERMS], limit[3] = {card->tlow, card->tmid, card->thigh};
    if (!(card->tlow > 0.0 && card->tmid >= card->tlow && card->thigh >= card->tmid))
        return gas_error(b, card, "TLOW, TMID and THIGH must be positive and in this order");
    for (int thousand = 0; thousand < 2; thousand++) {
        double scale = thousand ? 1e-3 : 1.0;
        for (int k = 0; k < 2; k++) {
            const double *from = k ? card->high : card->low;
            for (int j = 0; j < 4; j++) cp[k][j] = from[j] * pow(scale, j);
            cp[k][4] = 0.0;
            cp[k][5] = from[4] / (scale * scale);
        }
        *species = species_make(card->chname, card->mw, bag->gc, limit, (const double(*)[SPECIES_TERMS])cp);
        double ratio = species_cp(species, card->tmid) / species->r;
        if (ratio > 1.5 && ratio < 50.0) return 0;
        if (!thousand)
            diagnostics_add(b->diagnostics, SEVERITY_WARNING, card->source, "*AIRBAG",
                            "the coefficients of gas %s give cp = %.3g RG at TMID if T is the temperature; they are "
                            "taken as those of the NIST web book, for T/1000",
                            card->chname, ratio);
    }
    return gas_error(b, card, "the NIST coefficients give no heat capacity of a gas, with T or with T/1000");
}

static int chemkin_species(Builder *b, const AirbagDefinition *bag, const AirbagGasDefinition *card,
                           GasSpecies *species)
{
    if (!(card->mw > 0.0)) return gas_error(b, card, "MW must be positive");
    if (bag->data == 1) return nist_species(b, bag, card, species);
    if (bag->data == 3) {
        *species = species_make(card->chname, card->mw, bag->gc, (const double[3]){0.0, INFINITY, INFINITY},
                                (const double[2][SPECIES_TERMS]){{card->a, card->b, card->c, card->d, card->e}});
    } else {
        const NasaSpecies *known = species_find(card->chname);
        if (!known) {
            diagnostics_add(b->diagnostics, SEVERITY_ERROR, card->source, "*AIRBAG",
                            "CHNAME %s is not among the built-in species (docs/theory.md, G37); give its heat capacity "
                            "with DATA = 1 or 3",
                            card->chname);
            return -1;
        }
        double cp[2][SPECIES_TERMS] = {{0}};
        for (int k = 0; k < 2; k++)
            for (int j = 0; j < 5; j++) cp[k][j] = bag->gc * known->cp[k][j];
        *species = species_make(known->name, card->mw, bag->gc, known->limit, (const double(*)[SPECIES_TERMS])cp);
    }
    if (!(species_cp(species, bag->atmost) > species->r))
        return gas_error(b, card, "the heat capacity must exceed RG: coefficients are molar, in the units of RG");
    return 0;
}

int airbag_chemkin(Builder *b, const AirbagDefinition *bag, Airbag *airbag)
{
    GasModel *gas = &airbag->gas;
    GasSpecies *species;
    GasSource *sources;
    gas->kind = GAS_CHEMKIN;
    int status = ambient_fields(b, bag, gas);
    if (allocate(b, bag, gas, &species, &sources)) return -1;
    gas->total_inflow = true;
    gas->mass_flow_curve = airbag_spline(b, bag->lcidm, "LCIDM", bag->card3, &status);
    int temperature = airbag_spline(b, bag->lcidt, "LCIDT", bag->card3, &status);
    gas->total_inflow = gas->mass_flow_curve >= 0;
    if (gas->total_inflow && temperature < 0 && !status)
        status = airbag_error(b, bag->card3, "LCIDM is given, so LCIDT must be: the temperature of the inflow");
    double initial[BILLOW_AIRBAG_GASES];
    for (int i = 0; i < bag->ngas; i++) {
        const AirbagGasDefinition *card = &bag->gases[i];
        if (chemkin_species(b, bag, card, &species[i])) status = -1;
        sources[i].temperature_curve = temperature;
        sources[i].mole_fraction = card->fmole;
        sources[i].mole_fraction_curve = airbag_curve(b, card->lcidn, "LCIDN", card->source, &status);
        initial[i] = card->fmolet;
    }
    gas->vent_coefficient = bag->c23;
    gas->vent_area = bag->a23;
    if (status) return -1;
    return initial_fractions(b, bag, true, "FMOLET", initial, species, sources);
}
