/* Numbers in every spelling that decks know, and what is none. */
#include "tests/deck_case.h"

#include <float.h>
#include <math.h>
#include <stdlib.h>

#include "io/number.h"

static double parsed(const char *text)
{
    double value = 12345.678;
    if (number_parse(text, strlen(text), &value) != NUMBER_FINE) print_error("'%s'\n", text);
    assert_int_equal(number_parse(text, strlen(text), &value), NUMBER_FINE);
    return value;
}

static void numbers_in_every_spelling(void **state)
{
    (void)state;
    static const struct {
        const char *text;
        double value;
    } cases[] = {
        {"0", 0},
        {"1", 1},
        {"+1", 1},
        {"-7", -7},
        {"5.", 5},
        {".5", 0.5},
        {"-.5", -0.5},
        {"1.5-3", 1.5e-3},
        {"1.5+3", 1500},
        {"1.5D-3", 1.5e-3},
        {"1.5d3", 1500},
        {"1e5", 1e5},
        {"1E+05", 1e5},
        {"17.86000E-7", 17.86e-7},
        {"1.00000E20", 1e20},
        {"-1-1", -0.1},
        {"00012", 12},
        {"1e-400", 0},
        {"0e99999999999", 0},
        {"123456789012345678", 123456789012345678.0},
        {"0.1", 0.1},
        {"-2.2250738585072014E-308", -DBL_MIN},
        {"1.7976931348623157E308", DBL_MAX},
        {"3.14159265358979323846264338327950288", 3.14159265358979323846},
        {"1000000000000000000000000000000", 1e30},
        {"9007199254740993", 9007199254740992.0},
        {"10.00000000000000000", 10},
        {"0.000000000000000000000000000001", 1e-30},
    };
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        double value = parsed(cases[i].text);
        if (value != cases[i].value) print_error("'%s' gives %.17g\n", cases[i].text, value);
        assert_true(value == cases[i].value);
    }
}

static void what_is_no_number(void **state)
{
    (void)state;
    static const char *const cases[] = {"",      "-",    "+",   ".",   "e5",   "1e",  "1e+", "1.2.3", "1 2",
                                        "0x10",  "nan",  "inf", "1-",  "1+-2", "--1", "1,2", "1e5.",  "12a",
                                        "1e5e5", "MECH", "&a",  "1..", "- 1",  "1d ", "\x80"};
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        double value;
        NumberStatus status = number_parse(cases[i], strlen(cases[i]), &value);
        if (status != NUMBER_MALFORMED) print_error("'%s' is accepted\n", cases[i]);
        assert_int_equal(status, NUMBER_MALFORMED);
    }
    double value;
    assert_int_equal(number_parse("1e400", 5, &value), NUMBER_TOO_LARGE);
    assert_int_equal(number_parse("-9.9+9999", 9, &value), NUMBER_TOO_LARGE);
    char digits[2000];
    memset(digits, '1', sizeof digits);
    assert_int_equal(number_parse(digits, sizeof digits, &value), NUMBER_MALFORMED);
    assert_int_equal(number_parse(digits, 350, &value), NUMBER_TOO_LARGE);
}

/* The fast path must round as strtod does. */
static void numbers_are_rounded_correctly(void **state)
{
    (void)state;
    srand(7);
    for (int i = 0; i < 20000; i++) {
        char text[64];
        double value = ((double)rand() / RAND_MAX - 0.5) * pow(10, rand() % 40 - 20);
        snprintf(text, sizeof text, "%.*e", rand() % 18, value);
        assert_true(parsed(text) == strtod(text, NULL));
        snprintf(text, sizeof text, "%.*f", rand() % 12, value);
        assert_true(parsed(text) == strtod(text, NULL));
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(numbers_in_every_spelling),
        cmocka_unit_test(what_is_no_number),
        cmocka_unit_test(numbers_are_rounded_correctly),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
