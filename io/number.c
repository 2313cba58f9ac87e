/* Numbers as decks write them: C and Fortran spellings, 1.5-3 and 1.5D-3 included. */
#include "io/number.h"

#include <math.h>
#include <stdbool.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

enum {
    LONGEST_NUMBER = 400,    /* characters; more is no number anybody writes */
    EXACT_POWER = 22,        /* 10^22 is the largest power of ten that a double holds exactly */
    LARGEST_EXPONENT = 9999, /* beyond any double; stops the count */
};

static const uint64_t LARGEST_EXACT = 1ULL << 53; /* all integers up to here are doubles */

/* A number taken apart: sign * digits * 10^exponent. */
typedef struct Decimal {
    bool negative;
    uint64_t digits; /* valid while digit_count <= 19 */
    int digit_count; /* significant ones */
    int exponent;
    size_t mantissa_end, exponent_start; /* places in the text: where the exponent's letter (if any) and sign begin */
} Decimal;

static bool is_digit(char c)
{
    return c >= '0' && c <= '9';
}

static bool is_exponent_letter(char c)
{
    return c == 'e' || c == 'E' || c == 'd' || c == 'D';
}

/* Reads digits and the point; the place after them, or 0 if there is no digit. */
static size_t scan_mantissa(const char *text, size_t length, size_t at, Decimal *decimal)
{
    bool any = false, point = false;
    for (; at < length; at++) {
        if (text[at] == '.' && !point) {
            point = true;
            continue;
        }
        if (!is_digit(text[at])) break;
        any = true;
        if (decimal->digit_count > 0 || text[at] != '0') {
            if (decimal->digit_count < 19) decimal->digits = 10 * decimal->digits + (uint64_t)(text[at] - '0');
            decimal->digit_count++;
        }
        if (point) decimal->exponent--;
    }
    return any ? at : 0;
}

/* Reads the exponent from at to the end; false if it is malformed. */
static bool scan_exponent(const char *text, size_t length, size_t at, Decimal *decimal)
{
    decimal->mantissa_end = at;
    if (is_exponent_letter(text[at])) at++;
    decimal->exponent_start = at;
    bool negative = at < length && text[at] == '-';
    if (at < length && (text[at] == '-' || text[at] == '+')) at++;
    if (at == length) return false;
    int exponent = 0;
    for (; at < length; at++) {
        if (!is_digit(text[at])) return false;
        if (exponent < LARGEST_EXPONENT) exponent = 10 * exponent + (text[at] - '0');
    }
    decimal->exponent += negative ? -exponent : exponent;
    return true;
}

/* The general case, left to the C library once the exponent has its letter e. */
static double convert_slowly(const char *text, size_t length, const Decimal *decimal)
{
    char copy[LONGEST_NUMBER + 3];
    memcpy(copy, text, decimal->mantissa_end);
    size_t at = decimal->mantissa_end;
    if (decimal->mantissa_end < length) {
        copy[at++] = 'e';
        memcpy(copy + at, text + decimal->exponent_start, length - decimal->exponent_start);
        at += length - decimal->exponent_start;
    }
    copy[at] = '\0';
    return strtod(copy, NULL);
}

NumberStatus number_parse(const char *text, size_t length, double *value)
{
    static const double power[EXACT_POWER + 1] = {1e0,  1e1,  1e2,  1e3,  1e4,  1e5,  1e6,  1e7,
                                                  1e8,  1e9,  1e10, 1e11, 1e12, 1e13, 1e14, 1e15,
                                                  1e16, 1e17, 1e18, 1e19, 1e20, 1e21, 1e22};
    if (length == 0 || length > LONGEST_NUMBER) return NUMBER_MALFORMED;
    Decimal decimal = {.negative = text[0] == '-', .mantissa_end = length, .exponent_start = length};
    size_t at = scan_mantissa(text, length, text[0] == '-' || text[0] == '+', &decimal);
    if (at == 0) return NUMBER_MALFORMED;
    if (at < length) {
        if (!is_exponent_letter(text[at]) && text[at] != '+' && text[at] != '-') return NUMBER_MALFORMED;
        if (!scan_exponent(text, length, at, &decimal)) return NUMBER_MALFORMED;
    }
    if (decimal.digit_count <= 19) {
        for (; decimal.digits > LARGEST_EXACT && decimal.digits % 10 == 0; decimal.exponent++) decimal.digits /= 10;
    }
    /* Two exact operands and one rounding: as good as the slow way, and most of a mesh's numbers are such. */
    if (decimal.digit_count <= 19 && decimal.digits <= LARGEST_EXACT && abs(decimal.exponent) <= EXACT_POWER) {
        double digits = (double)decimal.digits;
        double size = decimal.exponent < 0 ? digits / power[-decimal.exponent] : digits * power[decimal.exponent];
        *value = decimal.negative ? -size : size;
        return NUMBER_FINE;
    }
    *value = convert_slowly(text, length, &decimal);
    return isinf(*value) ? NUMBER_TOO_LARGE : NUMBER_FINE;
}
