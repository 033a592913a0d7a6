/* A variable and the result of a function are int. */
int count(void);
int main(void) { static int total; total = count(); return 0; }
