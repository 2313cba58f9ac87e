/* Parameters and expressions: definitions, scopes in one file, duplicates, use in fields, and hostile input. */
#include "tests/deck_case.h"

#include <math.h>
#include <stdlib.h>

#include "io/expression.h"
#include "io/parameters.h"
#include "solver/memory.h"

static int evaluate(const char *text, ExpressionValue *value)
{
    char message[200];
    return expression_evaluate(text, strlen(text), NULL, NULL, value, message, sizeof message);
}

static void assert_value(const char *text, double expected, bool is_integer)
{
    ExpressionValue value = {0};
    int status = evaluate(text, &value);
    double scale = fabs(expected) > 1 ? fabs(expected) : 1;
    bool fine = status == 0 && fabs(value.value - expected) <= 4e-16 * scale && value.is_integer == is_integer;
    if (!fine) print_error("%s gives %.17g, %s\n", text, value.value, value.is_integer ? "integer" : "real");
    assert_true(fine);
}

static void expressions_have_the_usual_precedence(void **state)
{
    (void)state;
    assert_value("1+2*3", 7, true);
    assert_value("(1+2)*3", 9, true);
    assert_value("-2**2", -4, true);
    assert_value("2**3**2", 512, true);
    assert_value("2^-1", 0.5, false);
    assert_value("2.^-1", 0.5, false);
    assert_value("2*-3", -6, true);
    assert_value("1.5-3", -1.5, false);
    assert_value("1.5e-3*2", 3e-3, false);
    assert_value("1d2", 100, false);
    assert_value(" 8 / 2 / 2 ", 2, true);
    assert_value("10-4-3", 3, true);
    assert_value("- - 3", 3, true);
    assert_value(".5+.5", 1, false);
    assert_value("2 ** 0.5", sqrt(2), false);
}

static void integers_divide_like_integers(void **state)
{
    (void)state;
    assert_value("7/2", 3, true);
    assert_value("-7/2", -3, true);
    assert_value("7/2.", 3.5, false);
    assert_value("1/3*3", 0, true);
    assert_value("float(7)/2", 3.5, false);
    assert_value("mod(7,4)", 3, true);
    assert_value("mod(-7,4)", -3, true);
    assert_value("ls_real(7)/2", 3.5, false);
    assert_value("ls_integer(3.5)", 3, true);
}

static void functions_are_known(void **state)
{
    (void)state;
    const double pi = 3.14159265358979323846;
    assert_value("pi", pi, false);
    assert_value("sin(pi/2)", 1, false);
    assert_value("COS(0)", 1, false);
    assert_value("tan(pi/4)", tan(pi / 4), false);
    assert_value("asin(1)", pi / 2, false);
    assert_value("acos(-1)", pi, false);
    assert_value("atan(1)*4", pi, false);
    assert_value("atan2(1,-1)", 0.75 * pi, false);
    assert_value("exp(1)", exp(1), false);
    assert_value("log(exp(2.))", 2, false);
    assert_value("log10(1000)", 3, false);
    assert_value("sqrt(16)", 4, false);
    assert_value("abs(-3)", 3, true);
    assert_value("abs(-3.5)", 3.5, false);
    assert_value("min(3,1,2)", 1, true);
    assert_value("max(3,1.5,2)", 3, false);
    assert_value("int(-2.7)", -2, true);
    assert_value("nint(2.5)", 3, true);
    assert_value("nint(-2.5)", -3, true);
    assert_value("aint(2.7)", 2, false);
    assert_value("sign(3,-2)", -3, true);
    assert_value("sign(-3,0)", 3, true);
    assert_value("sinh(1)+cosh(1)", exp(1), false);
    assert_value("sec(0)+csc(pi/2)+ctn(pi/4)", 3, false);
    assert_value("sqrt (4)", 2, false);
}

static void wrong_expressions_are_explained(void **state)
{
    (void)state;
    static const struct {
        const char *text, *message;
    } cases[] = {
        {"", "missing number"},         {"1+", "missing number"},
        {"(1", "missing ')'"},          {"1)", "no operator"},
        {"1/0", "division by zero"},    {"1./0.", "division by zero"},
        {"foo(1)", "unknown function"}, {"foo", "unknown name"},
        {"sin()", "missing number"},    {"sin(1,2)", "too many"},
        {"atan2(1)", "too few"},        {"1..2", "malformed"},
        {"sqrt(-1)", "finite"},         {"log(0)", "finite"},
        {"10.**400", "finite"},         {"2**60", "2^53"},
        {"1 2", "no operator"},         {"&", "name missing"},
        {"1e999", "malformed"},         {"a$b", "unknown name"},
    };
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        ExpressionValue value;
        char message[200] = "";
        const char *text = cases[i].text;
        int status = expression_evaluate(text, strlen(text), NULL, NULL, &value, message, sizeof message);
        if (status != -1 || !strstr(message, cases[i].message)) print_error("%s: %s\n", text, message);
        assert_int_equal(status, -1);
        assert_non_null(strstr(message, cases[i].message));
    }
}

static void deep_nesting_is_refused(void **state)
{
    (void)state;
    size_t length = 1000000;
    char *text = memory_alloc(length, 1);
    assert_non_null(text);
    static const char kinds[] = "(-";
    for (size_t i = 0; i < sizeof kinds - 1; i++) {
        memset(text, kinds[i], length);
        ExpressionValue value;
        char message[200] = "";
        assert_int_equal(expression_evaluate(text, length, NULL, NULL, &value, message, sizeof message), -1);
        assert_non_null(strstr(message, "nesting"));
    }
    for (size_t i = 0; i + 3 <= length; i += 3) memcpy(text + i, "1**", 3);
    ExpressionValue value;
    char message[200] = "";
    assert_int_equal(expression_evaluate(text, length - 1, NULL, NULL, &value, message, sizeof message), -1);
    assert_non_null(strstr(message, "nesting"));
    for (size_t i = 0; i < length; i++) text[i] = i % 2 ? '+' : '1';
    assert_int_equal(expression_evaluate(text, length - 1, NULL, NULL, &value, message, sizeof message), 0);
    assert_true(value.value == 500000);
    memory_free(text);
}

static void fields_take_parameters(void **state)
{
    (void)state;
    DeckCase c = load_string("*KEYWORD\n"
                             "*PARAMETER\n"
                             "R     size      12.5I  count         7\n"
                             "Rneg         -1.5-2\n"
                             "*A\n"
                             "     &size    &count     -&neg\n"
                             "&SIZE,-&count,<2*&size+count>\n");
    CardReader reader = open_block(&c, 0);
    Record r;
    assert_int_equal(card_read(&reader, mixed_fields, 3, &r, true, "card 1", NULL), 0);
    assert_no_messages(&c);
    assert_true(r.a == 12.5 && r.id == 7 && r.b == 0.015);
    assert_int_equal(card_read(&reader, mixed_fields, 3, &r, true, "card 1", NULL), 0);
    assert_no_messages(&c);
    assert_true(r.a == 12.5 && r.id == -7 && r.b == 32);
    close_case(&c);
}

static void free_format_and_long_format_parameters(void **state)
{
    (void)state;
    DeckCase c = load_string("*KEYWORD\n"
                             "*PARAMETER\n"
                             "rterm, 0.2, istates, 80\n"
                             "*PARAMETER_EXPRESSION\n"
                             "rplot,term/(states-30)\n"
                             "R big     max(term,\n"
                             "             3*states)\n"
                             "I half    7/2.\n"
                             "*PARAMETER +\n"
                             "R                   long                2.25\n"
                             "*A\n"
                             "     &plot     &half      &big\n");
    /* in long format the name's field is 20 wide: "R    long" needs its type in the same field */
    Record r;
    assert_int_equal(c.diagnostics.errors, 1);
    assert_int_equal(c.diagnostics.messages[0].source.line, 10);
    assert_int_equal(read_mixed(&c, &r), 0);
    assert_true(fabs(r.a - 0.2 / 50) < 1e-18 && r.id == 3 && r.b == 240);
    close_case(&c);
    c = load_string(
        "*KEYWORD LONG=Y\n*PARAMETER\nR               long                2.25\n*A\n               &long\n");
    assert_int_equal(read_mixed(&c, &r), 0);
    assert_no_messages(&c);
    assert_true(r.a == 2.25);
    close_case(&c);
}

static void expressions_follow_fields_and_lines(void **state)
{
    (void)state;
    DeckCase c = load_string("*KEYWORD\n*PARAMETER_EXPRESSION\nI n       3\n*PARAMETER\nRx,<n/2.>,Iy,<max(n,5)>\n"
                             "*A\n   <&x*2>    <y-n>   -<&x>\n");
    Record r;
    assert_int_equal(read_mixed(&c, &r), 0);
    assert_no_messages(&c);
    assert_true(r.a == 3 && r.id == 2 && r.b == -1.5);
    close_case(&c);
    c = load_string("*KEYWORD\n*A\n<1+2+3+4+5+6>       1\n");
    assert_int_equal(read_mixed(&c, &r), -1);
    assert_only_message(&c, SEVERITY_ERROR, 3, "without its closing '>'");
    close_case(&c);
}

static void text_parameters(void **state)
{
    (void)state;
    static const FieldSpec fields[] = {RECORD_FIELD("T", 'A', 10, text), RECORD_FIELD("A", 'F', 10, a)};
    DeckCase c = load_string("*KEYWORD\n*PARAMETER\nC flag     DECOUPLE\n*A\n     &flag       1.0\n&other    &flag\n");
    CardReader reader = open_block(&c, 0);
    Record r;
    assert_int_equal(card_read(&reader, fields, 2, &r, true, "card 1", NULL), 0);
    assert_string_equal(r.text, "DECOUPLE");
    assert_no_messages(&c);
    assert_int_equal(card_read(&reader, fields, 2, &r, true, "card 1", NULL), -1);
    assert_string_equal(r.text, "&other");
    assert_only_message(&c, SEVERITY_ERROR, 6, "the text parameter 'flag'");
    close_case(&c);
}

static void use_before_definition_is_an_error(void **state)
{
    (void)state;
    DeckCase c = load_string("*KEYWORD\n*A\n      &one\n*PARAMETER\nR one       1.0\n*B\n      &one      &two\n");
    CardReader reader = open_block(&c, 0);
    Record r;
    assert_int_equal(card_read(&reader, mixed_fields, 3, &r, true, "card 1", NULL), -1);
    assert_only_message(&c, SEVERITY_ERROR, 3, "the parameter 'one' before its definition on line 5");
    reader = open_block(&c, 1);
    assert_int_equal(card_read(&reader, mixed_fields, 3, &r, true, "card 1", NULL), -1);
    assert_true(r.a == 1);
    assert_non_null(strstr(c.diagnostics.messages[1].text, "the undefined parameter 'two'"));
    close_case(&c);
}

/* Defines p = 1 and p = 2 under a rule and tells what the blocks between and after see. */
static void assert_duplicate(const char *rule, const char *option, double after, int warnings, int errors)
{
    char deck[400];
    snprintf(deck, sizeof deck,
             "*KEYWORD\n%s*PARAMETER%s\nR p       1.0\n*A\n&p\n*PARAMETER%s\nR p       2.0\n*B\n&p\n", rule, option,
             option);
    DeckCase c = load_string(deck);
    Record r;
    CardReader reader = open_block(&c, 0);
    assert_int_equal(card_read(&reader, mixed_fields, 3, &r, true, "card 1", NULL), 0);
    assert_true(r.a == 1);
    assert_int_equal(read_mixed(&c, &r), 0);
    assert_true(r.a == after);
    assert_int_equal(c.diagnostics.warnings, warnings);
    assert_int_equal(c.diagnostics.errors, errors);
    close_case(&c);
}

static void duplicates_follow_the_rule(void **state)
{
    (void)state;
    assert_duplicate("", "", 1, 1, 0);
    assert_duplicate("*PARAMETER_DUPLICATION\n         1\n", "", 1, 1, 0);
    assert_duplicate("*PARAMETER_DUPLICATION\n         0\n", "", 1, 1, 0);
    assert_duplicate("*PARAMETER_DUPLICATION\n\n", "", 1, 1, 0);
    assert_duplicate("*PARAMETER_DUPLICATION\n         2\n", "", 2, 1, 0);
    assert_duplicate("*PARAMETER_DUPLICATION\n         3\n", "", 1, 0, 1);
    assert_duplicate("*PARAMETER_DUPLICATION\n4\n", "", 2, 0, 0);
    assert_duplicate("*PARAMETER_DUPLICATION\n         5\n", "", 1, 0, 0);
    assert_duplicate("", "_MUTABLE", 2, 0, 0);
    DeckCase c = load_string("*KEYWORD\n*PARAMETER_DUPLICATION\n         9\n*A\n");
    assert_only_message(&c, SEVERITY_ERROR, 3, "'9' is no DFLAG");
    close_case(&c);
}

static void assert_bad_definition(const char *lines, int line, const char *part)
{
    char deck[400];
    snprintf(deck, sizeof deck, "*KEYWORD\n%s\n*A\n", lines);
    DeckCase c = load_string(deck);
    assert_int_equal(c.status, -1);
    assert_only_message(&c, SEVERITY_ERROR, line, part);
    close_case(&c);
}

static void wrong_definitions_are_reported(void **state)
{
    (void)state;
    assert_bad_definition("*PARAMETER\nX one       1.0", 3, "must begin with R, I or C");
    assert_bad_definition("*PARAMETER\nR           1.0", 3, "holds no name");
    assert_bad_definition("*PARAMETER\nR a-b       1.0", 3, "holds no name");
    assert_bad_definition("*PARAMETER\nI one       1.5", 3, "is no whole number");
    assert_bad_definition("*PARAMETER\nR one       abc", 3, "'abc' is not a number");
    assert_bad_definition("*PARAMETER\nR one      &abc", 3, "the undefined parameter 'abc'");
    assert_bad_definition("*PARAMETER_EXPRESSION\nR one     1/0", 3, "division by zero");
    assert_bad_definition("*PARAMETER_EXPRESSION\nR one     one+1", 3, "the undefined parameter 'one'");
    assert_bad_definition("*PARAMETER_EXPRESSION\n          2+1", 3, "no parameter's name");
    assert_bad_definition("*PARAMETER\n               1.0", 3, "no parameter's name");
}

/* A bad definition is one error, not one for each use. */
static void uses_of_a_bad_definition_are_silent(void **state)
{
    (void)state;
    DeckCase c =
        load_string("*KEYWORD\n*PARAMETER\nR a         x.y\n*PARAMETER_EXPRESSION\nR b       a*2\nR c       1\n"
                    "*A\n        &a         1        &b\n");
    Record r;
    assert_int_equal(read_mixed(&c, &r), -1);
    assert_only_message(&c, SEVERITY_ERROR, 3, "'x.y' is not a number");
    close_case(&c);
}

static void lost_remainders_are_warned_of(void **state)
{
    (void)state;
    DeckCase c = load_string("*KEYWORD\n*PARAMETER_EXPRESSION\nR a       7/2\nR b       8/2\n*A\n&a,1,&b\n");
    Record r;
    assert_int_equal(read_mixed(&c, &r), 0);
    assert_true(r.a == 3 && r.b == 4);
    assert_only_message(&c, SEVERITY_WARNING, 3, "'7/2' divides integers and loses a remainder");
    close_case(&c);
    c = load_string("*KEYWORD\n*A\n   <1/3>         1\n");
    assert_int_equal(read_mixed(&c, &r), 0);
    assert_only_message(&c, SEVERITY_WARNING, 3, "A (columns 1-10): '<1/3>' divides integers");
    close_case(&c);
}

static void odd_options_are_left_to_the_readers(void **state)
{
    (void)state;
    DeckCase c = load_string("*KEYWORD\n*PARAMETER_NOTHING\nR a 1\n*PARAMETER_EXPRESSION_LOCAL_MUTABLE\nR b,1.\n");
    assert_no_messages(&c);
    assert_int_equal(c.deck.blocks.count, 1);
    assert_string_equal(c.deck.blocks.items[0].keyword, "*PARAMETER_NOTHING");
    close_case(&c);
}

static void thousands_of_parameters_are_found(void **state)
{
    (void)state;
    enum { COUNT = 20000 };
    char *deck = memory_alloc(COUNT * 24 + 200, 1);
    assert_non_null(deck);
    size_t length = (size_t)sprintf(deck, "*KEYWORD\n*PARAMETER\n");
    for (int i = 0; i < COUNT; i++) length += (size_t)sprintf(deck + length, "Ip%d,%d\n", i, i);
    sprintf(deck + length, "*A\n0.,&p%d\n", COUNT / 3);
    DeckCase c = load_string(deck);
    Record r;
    assert_int_equal(read_mixed(&c, &r), 0);
    assert_no_messages(&c);
    assert_int_equal(r.id, COUNT / 3);
    close_case(&c);
    memory_free(deck);
}

/* A long expression over many lines is cut off with a message, not read for ever. */
static void endless_expressions_are_refused(void **state)
{
    (void)state;
    size_t lines = 5000;
    char *deck = memory_alloc(lines * 20 + 200, 1);
    assert_non_null(deck);
    size_t length = (size_t)sprintf(deck, "*KEYWORD\n*PARAMETER_EXPRESSION\nR a       1\n");
    for (size_t i = 0; i < lines; i++) length += (size_t)sprintf(deck + length, "          +1+1+1\n");
    sprintf(deck + length, "*A\n");
    DeckCase c = load_string(deck);
    assert_only_message(&c, SEVERITY_ERROR, 3, "too long");
    close_case(&c);
    memory_free(deck);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(expressions_have_the_usual_precedence),
        cmocka_unit_test(integers_divide_like_integers),
        cmocka_unit_test(functions_are_known),
        cmocka_unit_test(wrong_expressions_are_explained),
        cmocka_unit_test(deep_nesting_is_refused),
        cmocka_unit_test(fields_take_parameters),
        cmocka_unit_test(free_format_and_long_format_parameters),
        cmocka_unit_test(expressions_follow_fields_and_lines),
        cmocka_unit_test(text_parameters),
        cmocka_unit_test(use_before_definition_is_an_error),
        cmocka_unit_test(duplicates_follow_the_rule),
        cmocka_unit_test(wrong_definitions_are_reported),
        cmocka_unit_test(uses_of_a_bad_definition_are_silent),
        cmocka_unit_test(lost_remainders_are_warned_of),
        cmocka_unit_test(odd_options_are_left_to_the_readers),
        cmocka_unit_test(thousands_of_parameters_are_found),
        cmocka_unit_test(endless_expressions_are_refused),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
