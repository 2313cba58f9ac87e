/* Numbers as decks write them. */
#ifndef BILLOW_NUMBER_H
#define BILLOW_NUMBER_H

#include <stddef.h>

typedef enum NumberStatus {
    NUMBER_FINE,
    NUMBER_MALFORMED,
    NUMBER_TOO_LARGE, /* beyond the range of a double */
} NumberStatus;

/* Reads text[0 .. length), without blanks around it, as one number: an optional sign, digits with an optional decimal
 * point, and an optional exponent written e5, E+5, d-5, D5, +5 or -5. Correctly rounded. Underflow gives 0 or a
 * denormal. */
NumberStatus number_parse(const char *text, size_t length, double *value);

#endif
