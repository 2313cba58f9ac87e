/* The language of *DEFINE_CURVE_FUNCTION and *DEFINE_FUNCTION: values, spellings, refusals, bounds. */
#include "tests/keyword_case.h"

#include <math.h>

#include "io/function_text.h"

static double evaluate(const char *text, bool is_curve, const double *inputs)
{
    FunctionProgram program;
    FunctionTrouble trouble;
    double value = NAN;
    const char *why = "";
    if (function_compile(text, strlen(text), is_curve, NULL, NULL, &program, &trouble)) {
        print_error("%s: %s\n", text, trouble.message);
        return NAN;
    }
    if (function_evaluate(&program, inputs, &value, &why)) print_error("%s: %s\n", text, why);
    memory_free(program.code);
    return value;
}

static void assert_value(const char *text, bool is_curve, const double *inputs, double expected)
{
    double value = evaluate(text, is_curve, inputs);
    if (!(fabs(value - expected) <= 1e-14 * fmax(1, fabs(expected))))
        fail_msg("%s gives %.17g, not %.17g", text, value, expected);
}

static void refuse(const char *text, bool is_curve, int line, const char *part)
{
    FunctionProgram program;
    FunctionTrouble trouble;
    int status = function_compile(text, strlen(text), is_curve, NULL, NULL, &program, &trouble);
    if (status != -1 || !strstr(trouble.message, part) || trouble.line != line)
        fail_msg("'%s': %d, line %d: %s", text, status, trouble.line, trouble.message);
    assert_null(program.code);
    assert_int_equal(memory_in_use(), 0);
}

static void test_curve_expressions(void **state)
{
    (void)state;
    const double time[] = {0.25};
    assert_value("TIME", true, time, 0.25);
    assert_value("3/2 + time*4", true, time, 2.5); /* numbers are real */
    assert_value("poly(TIME, 0., 1., 2., 4.)", true, time, 1.75);
    assert_value("STEP(TIME, 0., 1., 1., 3.)", true, time, 1 + 2 * 0.0625 * 2.5);
    assert_value("STEP(TIME, 0.3, 1., 1., 3.) + STEP(TIME, 0, 0, 0.2, 5)", true, time, 6);
    assert_value("IF(TIME - 0.5, 1, 2, 3)\n* 2", true, time, 2);
    assert_value("IF(TIME - 0.25, 1, 2, 3)", true, time, 2);
    assert_value("IF(TIME, 1, 2, 3)", true, time, 3);
    assert_value("cheby(time, 0, 1, 2, 3)", true, time, 1 + 2 * 0.25 + 3 * (2 * 0.0625 - 1));
    assert_value("forcos(time, 0, 2, 1, 2, 3)", true, time, 1 + 2 * cos(0.5) + 3 * cos(1.0));
    assert_value("forsin(time, 0, 2, 1, 2, 3)", true, time, 1 + 2 * sin(0.5) + 3 * sin(1.0));
    assert_value("shf(time, 0.05, 3, 2, 0.1, 7)", true, time, 3 * sin(2 * 0.2 - 0.1) + 7);
    assert_value("sin(30*DTOR) + asin(1)*RTOD/90 + PI", true, time, 0.5 + 1 + 3.14159265358979323846);
    assert_value("TIME > 0.2 && !(TIME > 1)", true, time, 1);
    assert_value("TIME.GT.0.2.and..not.time.lt.1", true, time, 0);
    assert_value("1.eq.2 || 1./=1", true, time, 0);
    assert_value("time<0.1 ? 5 : time < 1 ? 6 : 7", true, time, 6);
    assert_value("(-2.)**3 + 2**-1", true, time, -7.5);
    const double more[] = {2, 3, 5, 7};
    assert_value("TIME + 10*TIMESTEP + 100*NCYCLE + 1000*DX(7)", true, more, 2 + 30 + 500 + 7000);
    assert_value("DM(1,2) + 10*VZ(3) + 100*LC55 + 1000*DM(1,2)", true, more, 2 + 30 + 500 + 2000);
}

static void test_inputs(void **state)
{
    (void)state;
    FunctionProgram program;
    FunctionTrouble trouble;
    const char *text = "VY(12, 34) + LC99 + vy(12,34) + TIME";
    assert_int_equal(function_compile(text, strlen(text), true, NULL, NULL, &program, &trouble), 0);
    assert_int_equal(program.input_count, 3); /* each once */
    assert_int_equal(program.input[0].kind, INPUT_VELOCITY);
    assert_int_equal(program.input[0].component, 1);
    assert_int_equal(program.input[0].id[0], 12);
    assert_int_equal(program.input[0].id[1], 34);
    assert_int_equal(program.input[1].kind, INPUT_CURVE);
    assert_int_equal(program.input[1].id[0], 99);
    assert_int_equal(program.input[2].kind, INPUT_TIME);
    memory_free(program.code);
}

static void test_c_functions(void **state)
{
    (void)state;
    const double in[] = {3, 0.7, 2};
    assert_value("float f(float p, float v, float t) { return p + 10*v + 100*t; }", false, in, 210);
    assert_value("f(a,b,c)=a*2+b*c+sqrt(a*c)", false, in, 6 + 1.4 + sqrt(6));
    assert_value("/* by volume */ float f(float p, float v)\n{ float x = 0., v1 = 0.5, v2 = 1.1;\n"
                 "if (v >= 0 && v < v1) { x = 1.2; } elseif (v >= v1 && v < v2) { x = 1; } // here\n"
                 "else if (v >= v2) { x = 0.; }\n return -0.06*x; }",
                 false, in, -0.06);
    assert_value("double f(double n){ int i; double s=0; for(i=1;i<=n;i++) s+=i; return s; }", false, in, 6);
    assert_value("float f(float n){ float s=0; while(1){ s+=n; if(s>10) break; if(s<5) continue; s-=1; } return s; }",
                 false, in, 12);
    assert_value("float f(float n){ int k=0; do { k+=2; n--; } while(n>0.5); return k*1.5f; }", false, in, 9);
    assert_value("float f(float n){ int i=7; i/=2; return i + 7/2 + (float)7/2 + (int)2.9 + 7%4; }", false, in,
                 3 + 3 + 3.5 + 2 + 3);
    assert_value("float f(float a){ a = a > 2 ? fmax(a, 5) : 0; { float b = a; a *= b; } return pow(a, 0.5); }", false,
                 in, 5);
    assert_value(
        "float f(float n){ float s=0; for(int i=0;i<3;i++) for(int j=0;j<3;j++){ if(j>i) break; s+=1;} return s;}",
        false, in, 6);
    assert_value("float f(float n){ int s=0; for(;;){ if(s>=4) return s; s++; } }", false, in, 4);
    assert_value("float myfunction(float p) { return !p; }", false, in, 0);
}

static void test_fortran_functions(void **state)
{
    (void)state;
    const double in[] = {3, 0.7, 2};
    assert_value("real function f(p, v)\nreal p, v\nf = p + 10.*v\nreturn\nend", false, in, 10);
    assert_value("FUNCTION F(P,V)\n  IF (P.GT.2.AND.V.LT.1) THEN\n F = 1 ! yes\n ELSE IF (P.EQ.2) THEN\n F = 2\n"
                 " ELSE\n F = 3\n END IF\nEND FUNCTION F",
                 false, in, 1);
    assert_value("function f(p)\nimplicit none\ninteger i\nreal s\ns = 0\ndo i = 1, 10, 2\nif (i == 7) cycle\n"
                 "if (i > 8) exit\ns = s + i\nenddo\nf = s + 7/2 + i\nend",
                 false, in, 9 + 3 + 9);
    assert_value(
        "function f(x)\nk = 2.9\nf = 0\ndo while (x > 0)\nf = f + x &\n + 1\nx = x - 1\nend do\nf = f + k\nend", false,
        in, 11);
    assert_value("function f(x)\nf = 0\ndo i = 3, 1, -1\nf = 10*f + i\nend do\nend", false, in, 321);
    assert_value("function f(x)\nif (x /= 3.) f = 5; f = f + 1\nend", false, in, 1);
}

static void test_refusals(void **state)
{
    (void)state;
    refuse("TIME +", true, 0, "a missing number");
    refuse("FOO(TIME)", true, 0, "an unknown function at 'FOO");
    refuse("TIME\n+ bar", true, 1, "an unknown name at 'bar'");
    refuse("DX(1,2,3)", true, 0, "a local system");
    refuse("DX(TIME)", true, 0, "(..)");
    refuse("TIME TIME", true, 0, "after the end");
    refuse("system(1)", true, 0, "an unknown function");
    refuse("float f(float x) {\n return x\n}", false, 2, "a missing ';'");
    refuse("float f(float x) {\n y = x; return y; }", false, 1, "not declared");
    refuse("float f(float x) { float x; return x; }", false, 0, "declared twice");
    refuse("float f(float x) { float a[3]; return x; }", false, 0, "a missing ';' at '[3]");
    refuse("float f(float x) { break; return x; }", false, 0, "a jump out of a loop");
    refuse("float f(float x) { printf(x); return x; }", false, 0, "not declared, or a call");
    refuse("float f(float x) { return *x; }", false, 0, "a missing number");
    refuse("float f(float x) { return TIME; }", false, 0, "an unknown name");
    refuse("float f(float x) { return x; } int g", false, 0, "after the end");
    refuse("#include <stdio.h>", false, 0, "a missing name");
    refuse("function f(x)\nf = x", false, 1, "a missing 'end'");
    refuse("function f(x)\nif (x > 1) then\nf = x\nend", false, 3, "a missing 'end if'");
    refuse("function f(x)\nopen(7)\nend", false, 1, "a missing '='");
}

/* Nothing that a text says can hang, overflow or reach outside. */
static void test_bounds(void **state)
{
    (void)state;
    const char *endless[] = {"float f(float x){ while(1) x=x+1; return x; }", "function f(x)\ndo i=1,2,0\nend do\nend",
                             "float f(float x){ for(;;); return x; }"};
    for (size_t i = 0; i < 3; i++) {
        FunctionProgram program;
        FunctionTrouble trouble;
        const char *why = "";
        double value, in[] = {1};
        assert_int_equal(function_compile(endless[i], strlen(endless[i]), false, NULL, NULL, &program, &trouble), 0);
        assert_int_equal(function_evaluate(&program, in, &value, &why), -1);
        assert_non_null(strstr(why, "100000 operations"));
        memory_free(program.code);
    }
    static char deep[5000];
    memset(deep, '(', 300);
    strcpy(deep + 300, "1");
    refuse(deep, true, 0, "levels of nesting");
    strcpy(deep, "float f(float x) ");
    memset(deep + strlen(deep), '{', 200);
    refuse(deep, false, 0, "levels of blocks");
    memset(deep, '!', 4000);
    deep[4000] = '\0';
    refuse(deep, true, 0, "levels of nesting");
    char *end = deep + sprintf(deep, "f(a)=max(1");
    for (int i = 0; i < 40; i++) end += sprintf(end, ",1");
    refuse(deep, false, 0, "too many arguments");
    end = deep + sprintf(deep, "float f(float a){");
    for (int i = 0; i < 70; i++) end += sprintf(end, "float v%d;", i);
    refuse(deep, false, 0, "more than 64 variables");
    FunctionProgram program;
    FunctionTrouble trouble;
    const char *why = "", *none = "float f(float x) { if (x > 5) return 1; }";
    double value, in[] = {1};
    assert_int_equal(function_compile(none, strlen(none), false, NULL, NULL, &program, &trouble), 0);
    assert_int_equal(function_evaluate(&program, in, &value, &why), -1);
    memory_free(program.code);
}

/* Every prefix of a long function is refused or compiled, without a crash. */
static void test_prefixes(void **state)
{
    (void)state;
    const char *texts[] = {
        "float f(float n){ int i; float s=0; for(i=1;i<=n;i++){ if(i%2==0) continue; else s+=(int)1.5f; } "
        "do { s--; } while(s>3 && !(s<2)); while(s>1) s/=2; return s>0 ? s : -s; } /* end */",
        "real function f(x)\nreal x\ninteger i\nif (x .gt. 1.) then\nf=1\nelse if (x.lt.0) then\nf=2\nelse\n"
        "do i=1,3\nf=f+i\nif (f > 2) exit\nend do\nend if\nend"};
    for (int k = 0; k < 2; k++) {
        for (size_t n = 0; n <= strlen(texts[k]); n++) {
            FunctionProgram program;
            FunctionTrouble trouble;
            if (function_compile(texts[k], n, false, NULL, NULL, &program, &trouble) == 0) {
                double value, in[] = {3};
                const char *why;
                function_evaluate(&program, in, &value, &why);
                memory_free(program.code);
            }
            assert_int_equal(memory_in_use(), 0);
        }
    }
}

static void test_cards(void **state)
{
    (void)state;
    KeywordCase c = read_fine("*PARAMETER\nR peak          2.5\n*DEFINE_CURVE_FUNCTION_TITLE\nopening\n       100\n"
                              "&peak*STEP(TIME,0.,0.,1.E-3,\n1.)\n*DEFINE_FUNCTION\n       900 by volume\n"
                              "float f(float p, float v, float t)\n{\n return v;\n}\n");
    assert_int_equal(c.d.functions.count, 2);
    assert_true(c.d.functions.items[0].is_curve && !c.d.functions.items[1].is_curve);
    assert_int_equal(c.d.functions.items[0].id, 100);
    assert_string_equal(c.d.functions.items[0].title, "opening");
    assert_string_equal(c.d.functions.items[1].title, "by volume");
    double value, time = 1;
    const char *why;
    assert_int_equal(function_evaluate(&c.d.functions.items[0].program, &time, &value, &why), 0);
    assert_true(value == 2.5);
    close_case(&c);
    assert_one_error("*DEFINE_CURVE_FUNCTION\n       100\nTIME +\n  FOO\n", 4, "*DEFINE_CURVE_FUNCTION",
                     "an unknown name at 'FOO'");
    assert_one_error("*DEFINE_CURVE_FUNCTION\n       100\n", 2, "*DEFINE_CURVE_FUNCTION", "no text");
    assert_one_error("*DEFINE_FUNCTION\n         0\nf(a)=a\n", 2, "*DEFINE_FUNCTION", "FID is 0");
    assert_one_error("*DEFINE_CURVE_FUNCTION\n       100\n&nothing\n", 3, "*DEFINE_CURVE_FUNCTION", "nothing");
    assert_one_error("*DEFINE_CURVE_FUNCTION\n       100\nTIME\n*DEFINE_FUNCTION\n       100\nf(a)=a\n", 5,
                     "*DEFINE_FUNCTION", "function 100 is defined a second time");
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_curve_expressions), cmocka_unit_test(test_inputs),   cmocka_unit_test(test_c_functions),
        cmocka_unit_test(test_fortran_functions), cmocka_unit_test(test_refusals), cmocka_unit_test(test_bounds),
        cmocka_unit_test(test_prefixes),          cmocka_unit_test(test_cards),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
