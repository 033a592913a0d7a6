#define QA 3
int32_t quarter(void) { return QA; }
