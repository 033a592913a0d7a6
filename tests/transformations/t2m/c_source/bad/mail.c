Dear all,
please find the report (see below); it has 3 parts.
Best regards
