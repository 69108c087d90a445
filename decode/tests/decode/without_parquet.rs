//! Parquet, where it was not built in.

use adsdv_decode::{BeginError, Catalog, NotBuilt, Table, parquet, parquet_messages};
use adsdv_spec::Edition;

#[test]
fn parquet_is_refused_with_the_name_of_its_feature() {
    let catalog = Catalog::of(&Edition::V2026);
    let one = parquet(Table::Signals, &catalog, Vec::new(), "run.log").err();
    let many = parquet_messages(&catalog, |_| Ok(Vec::new()), "run.log").err();
    for error in [one, many] {
        let error = error.expect("it was not built in");
        assert_eq!(
            error.to_string(),
            "this build does not write Parquet: it was built without the feature parquet"
        );
        assert!(matches!(error, BeginError::NotBuilt(NotBuilt { format: "Parquet", feature: "parquet" })));
    }
}
