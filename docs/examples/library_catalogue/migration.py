"""Flock: version 1 of the catalogue's metamodel to version 2. What still fits is copied without a rule."""


def to_version_2(f, old, catalogue):
    """Writers are authors now, journals magazines, what a member borrowed loans."""
    f.retype("Writer", "Author")
    f.retype("Journal", "Magazine")

    @f.migrate("Library")
    def _(original, migrated):
        f.set(migrated, authors=original.writers)  # migrated.authors ::= original.writers

    @f.migrate("Item")  # of every kind; its shelf is dropped
    def _(original, migrated):
        f.set(migrated, authors=original.writers)

    @f.migrate("Member")
    def _(original, migrated):
        migrated.loans.extend([catalogue.Loan(item=f.equivalent(item)) for item in original.borrowed])
