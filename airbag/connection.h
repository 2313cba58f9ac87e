/* Two bags that vent into each other: *AIRBAG_INTERACTION (docs/theory.md, G42 to G46). */
#ifndef BILLOW_CONNECTION_H
#define BILLOW_CONNECTION_H

#include "airbag/gas.h"

/* Curve members are indices into the model's curves, -1 for none. */
typedef struct GasConnection {
    int bag[2];            /* indices of the airbags AB1, AB2 */
    double area;           /* AREA > 0 */
    int area_curve;        /* AREA < 0: over the absolute pressure upstream */
    int part;              /* PID, AREA = 0: index of the part whose area counts; -1 none */
    bool blocked;          /* PID < 0: without what is blocked by contact */
    double coefficient;    /* SF > 0 */
    int coefficient_curve; /* SF < 0: over time */
    int flow_curve;        /* LCID: mass flow over the difference of pressures, in place of all the above */
    int direction;         /* IFLOW: < 0 only from the first to the second, > 0 only back, 0 both */
} GasConnection;

/* One of the two bags. */
typedef struct GasSide {
    const GasModel *gas;
    GasState *state;
    double vsca, psca;
} GasSide;

/* Moves gas from the side of higher pressure over a span that begins at time, at constant volumes; part_area is the
 * current area of the part (used if that is what counts). Neither side passes the pressure of the other, for any span;
 * what one loses the other gets, to the last bit of both ledgers. */
void gas_connect(const GasConnection *connection, const Curve *curves, GasSide first, GasSide second, double time,
                 double span, double part_area);

/* A span that resolves the exchange: 5 % of the way to equal pressures. */
double gas_connection_scale(const GasConnection *connection, const Curve *curves, GasSide first, GasSide second,
                            double time, double part_area);

#endif
