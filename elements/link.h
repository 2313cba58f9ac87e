/* Links: springs, cables and trusses between two nodes, forces along the line between them. */
#ifndef BILLOW_LINK_H
#define BILLOW_LINK_H

#include <stdbool.h>
#include <stdint.h>

#include "elements/strap.h"

typedef struct Link {
    int id;   /* user's number of the element */
    int part; /* index into Model.parts */
    int32_t node[2];
    double ground[3];      /* the second end's place where node[1] is -1 [L] */
    bool logarithmic;      /* force on the logarithmic strain (truss), else on the elongation */
    bool tension_only;     /* cable */
    double stiffness;      /* force per elongation; of a truss force per strain */
    double length;         /* at which only the preload acts [L] */
    double preload;        /* [force] */
    const LawCurve *curve; /* force over L - length, stiffness its steepest; NULL: none. The Model's */
    const Strap *strap;    /* force over L/length - 1, stiffness its steepest; NULL: none. The Model's */
    double inverse[2];     /* 1/m of each end times the links that share it, at most; 0: the end does not move [1/M] */
} Link;

/* Tension at the length (negative: compression) and the energy stored, a strap's dissipated energy with it (K1 to K8,
 * K1a). peak: largest strain of a strap so far, below it the way back counts; else 0. */
double link_tension(const Link *link, double length, double peak, double *energy);

/* The strap's largest strain so far at this length, of the one before; 0 for other links. */
double link_peak(const Link *link, double length, double peak);

/* Change of the tension with the length, of straps on the loading curve. */
double link_slope(const Link *link, double length);

/* Upper bound of the square of the highest frequency with the masses at its ends (K5). */
double link_rate(const Link *link, double length, double tension);

#endif
