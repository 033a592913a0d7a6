#define QC 5
