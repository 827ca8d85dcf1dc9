"""What all studies share: cases on workers, tables, claims, figures.

A study is one file:

    @dataclass(frozen=True, kw_only=True)
    class Run(Case):
        ra: float
        def run(self, report, folder):
            return Outcome({"energy": [{"ra": self.ra, "ke": ..., "ke_err": ...}]})

    STUDY = Study(name="rb", cases=cases, figures=figures, claims=CLAIMS,
                  tables=[Table("energy", key=["ra"], columns=["ra", "ke", "ke_err"])])

    if __name__ == "__main__":
        main(STUDY)
"""
