#define QA 3
int quarter(void) { return QA; }
