/* *AIRBAG cards -> gas models: one function for each model. Private to solver/build_airbag*.c. */
#ifndef BILLOW_BUILD_AIRBAGS_H
#define BILLOW_BUILD_AIRBAGS_H

#include "solver/builder.h"

/* Curve id of a card's field, of either sign -> index; 0 -> -1. An unknown one is reported and sets *status to -1. */
int airbag_curve(Builder *b, int id, const char *field, Source source, int *status);

/* The same, but a negative id asks for the cubic spline through the curve's points. */
int airbag_spline(Builder *b, int id, const char *field, Source source, int *status);

/* The same for fields that take functions too, which are listed with the bag. *DEFINE_FUNCTION gets at most pressure,
 * volume and time. */
int airbag_exit_curve(Builder *b, Airbag *bag, int id, const char *field, Source source, int *status);

/* Reports an error at a card; -1. */
int airbag_error(Builder *b, Source source, const char *text);

/* Vents and leakage of the card that has C23 first (WANG_NEFSKE card 4, HYBRID card 4). 0, or -1 after reporting. */
int airbag_vents(Builder *b, const AirbagDefinition *bag, Airbag *airbag);

/* Vents that are parts and leaking materials of the bag; sets surface_parts. 0, or -1 after reporting. */
int airbag_leakage(Builder *b, const AirbagDefinition *bag, Airbag *airbag);

/* Fill the bag's gas, which is reset, from the cards. 0, or -1 after reporting. */
int airbag_simple(Builder *b, const AirbagDefinition *bag, Airbag *airbag);
int airbag_wang_nefske(Builder *b, const AirbagDefinition *bag, Airbag *airbag);
int airbag_hybrid(Builder *b, const AirbagDefinition *bag, Airbag *airbag);
int airbag_chemkin(Builder *b, const AirbagDefinition *bag, Airbag *airbag);
int airbag_pressure_volume(Builder *b, const AirbagDefinition *bag, Airbag *airbag);
int airbag_adiabatic(Builder *b, const AirbagDefinition *bag, Airbag *airbag);
int airbag_load_curve(Builder *b, const AirbagDefinition *bag, Airbag *airbag);
int airbag_linear_fluid(Builder *b, const AirbagDefinition *bag, Airbag *airbag);
int airbag_fluid_and_gas(Builder *b, const AirbagDefinition *bag, Airbag *airbag);

#endif
