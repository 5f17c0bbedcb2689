//! Tests of the room `navigation::landmark`: the test vectors of the depth-error model, and the rivals.

use nalgebra::{SMatrix, Unit, UnitQuaternion, Vector3};
use opnav::navigation::landmark::{
    Candidate, GroundPrior, Metric, Selector, Triangle, Viewpoint, bearing_jacobian, bearing_matrix, choose,
    golden_section, metric, posterior_position_variance_m2, scaled_metric, stacked_bearings,
};
use opnav::stats::random_stream;

const GRAVITY_M_S2: f64 = 3.711;

fn view(lander_in_site_m: [f64; 3], lander_velocity_in_site_m_s: [f64; 3]) -> Viewpoint {
    let mut covariance = SMatrix::<f64, 9, 9>::identity();
    covariance.fixed_view_mut::<3, 3>(0, 0).fill_diagonal(100.0 * 100.0);
    covariance.fixed_view_mut::<3, 3>(6, 6).fill_diagonal(0.01 * 0.01);
    Viewpoint {
        lander_in_site_m: lander_in_site_m.into(),
        lander_velocity_in_site_m_s: lander_velocity_in_site_m_s.into(),
        specific_force_in_site_m_s2: Vector3::new(0.5, 0.5, 4.5),
        gravity_in_site_m_s2: Vector3::new(0.0, 0.0, -GRAVITY_M_S2),
        interval_s: 1.0,
        sigma_bearing_rad: 1e-3,
        covariance,
        ground: GroundPrior::default(),
    }
}

/// Start of the reference trajectory.
fn at_start() -> Viewpoint {
    view([3300.0, 5870.0, 6570.0], [-56.0, -66.0, -90.0])
}

/// The reference trajectory at 60 s: quartic polynomials of the position.
fn at_60_s() -> Viewpoint {
    let t = 60.0_f64;
    let c = [
        [3300.0, -56.0, 0.34343434343, -8.8426351053e-4, 7.7295761e-7],
        [5870.0, -66.0, 0.10162228344, 9.9917654249e-4, -2.9551965e-6],
        [6570.0, -90.0, 0.70812672176, -3.6512971775e-3, 7.69795515e-6],
    ];
    let r = c.map(|c| (0..5).map(|k| c[k] * t.powi(k as i32)).sum());
    let v = c.map(|c| (1..5).map(|k| k as f64 * c[k] * t.powi(k as i32 - 1)).sum());
    view(r, v)
}

#[test]
fn depth_error_at_the_start_is_the_reference() {
    let triangle = Triangle::of(&at_start()).expect("a descent");
    let (alpha, beta) = triangle.minimum();
    assert!((alpha.to_degrees() - 46.12).abs() < 6e-3, "alpha {}", alpha.to_degrees());
    assert!((beta.to_degrees() - 66.48).abs() < 6e-3, "beta {}", beta.to_degrees());
    assert!((triangle.depth_error(alpha, beta) - 123.455).abs() < 1e-3);
}

#[test]
fn depth_error_at_60_s_is_the_reference() {
    let view = at_60_s();
    let triangle = Triangle::of(&view).expect("a descent");
    let (alpha, beta) = triangle.minimum();
    assert!((alpha.to_degrees() - 36.3641).abs() < 1e-3, "alpha {}", alpha.to_degrees());
    assert!((beta.to_degrees() - 71.2704).abs() < 1e-3, "beta {}", beta.to_degrees());
    assert!((triangle.depth_error(alpha, beta) - 104.650).abs() < 1e-3);
    let point_m =
        Selector::DepthError.ideal_landmark_in_site_m(&view, &mut random_stream(0, "test", 0)).expect("above");
    assert!((point_m - Vector3::new(1439.428, 3308.203, 0.0)).norm() < 2e-3, "landmark {point_m}");
}

/// The closed form is the minimum over both angles, and golden section finds the same point.
#[test]
fn closed_form_is_the_minimum() {
    for view in [at_start(), at_60_s()] {
        let triangle = Triangle::of(&view).expect("a descent");
        let (alpha, beta) = triangle.minimum();
        let least = triangle.depth_error(alpha, beta);
        let (alpha_found, beta_found) = triangle.minimum_by_search();
        assert!((alpha_found - alpha).abs() < 1e-12);
        assert!((beta_found - beta).abs() < 1e-3);
        let gamma = triangle.path_angle_rad;
        for i in 0..60 {
            let a = gamma + (std::f64::consts::PI - 2.0 * gamma) * f64::from(i) / 60.0;
            for j in 1..60 {
                let b = (std::f64::consts::PI - a) * f64::from(j) / 60.0;
                assert!(triangle.depth_error(a, b) >= least * (1.0 - 1e-12), "better at {a}, {b}");
            }
        }
    }
    // A baseline as long as the remaining path: the unconstrained branch, where α* exceeds γ.
    let steep = Triangle { range_to_ground_m: 100.0, baseline_m: 90.0, path_angle_rad: 0.1 };
    let (alpha, beta) = steep.minimum();
    assert!(alpha > 0.5);
    for (da, db) in [(1e-3, 0.0), (-1e-3, 0.0), (0.0, 1e-3), (0.0, -1e-3)] {
        assert!(steep.depth_error(alpha + da, beta + db) > steep.depth_error(alpha, beta));
    }
}

/// The triangle's two sides and the point that it names agree.
#[test]
fn triangle_names_the_point_of_its_angles() {
    let view = at_60_s();
    let triangle = Triangle::of(&view).expect("a descent");
    for azimuth in [0.0, 0.4, 1.3, 2.5] {
        let (alpha, beta) = (triangle.alpha_rad(azimuth), 0.6);
        let p = triangle.landmark_in_site_m(&view, alpha, beta);
        let relative = p - view.lander_in_site_m;
        assert!(p.z.abs() < 1e-9);
        assert!((relative.norm() - triangle.depth_m(alpha, beta)).abs() < 1e-8);
        assert!((relative.angle(&view.lander_velocity_in_site_m_s) - beta).abs() < 1e-9);
    }
    let mut level = view;
    level.lander_velocity_in_site_m_s.z = 1.0;
    assert_eq!(Triangle::of(&level), None);
}

#[test]
fn golden_section_counts_its_evaluations() {
    let count = std::cell::Cell::new(0);
    let function = |x: f64| {
        count.set(count.get() + 1);
        (x - 0.3).powi(2)
    };
    let (x, value) = golden_section(function, -1.0, 2.0, 19);
    assert_eq!(count.get(), 19);
    assert!((x - 0.3).abs() < 3.0 * 0.618_f64.powi(17) && value < 1e-6);
}

/// H is the derivative of the bearing with the paper's error state, and its null space holds yaw.
#[test]
fn bearing_jacobian_is_the_derivative() {
    let (r, p) = (Vector3::new(300.0, -200.0, 900.0), Vector3::new(-100.0, 250.0, 12.0));
    let c = UnitQuaternion::from_euler_angles(0.2, -0.1, 0.9);
    let bearing = |d: &SMatrix<f64, 12, 1>| {
        let attitude = UnitQuaternion::from_scaled_axis(-d.fixed_rows::<3>(6)) * c;
        attitude * (p + d.fixed_rows::<3>(9) - r - d.fixed_rows::<3>(0)).normalize()
    };
    let numeric = opnav::geometry::central_difference(bearing, &SMatrix::<f64, 12, 1>::zeros(), 1e-4);
    assert!((numeric - bearing_jacobian(&c, &(p - r), true)).norm() < 1e-8);
    let mut yaw = SMatrix::<f64, 12, 1>::zeros();
    yaw.fixed_rows_mut::<3>(0).copy_from(&-r.cross(&Vector3::z()));
    yaw.fixed_rows_mut::<3>(6).copy_from(&(c * Vector3::z()));
    yaw.fixed_rows_mut::<3>(9).copy_from(&-p.cross(&Vector3::z()));
    assert!((bearing_matrix(&c, &r, &p) * yaw).norm() < 1e-12);
    let singular = bearing_matrix(&c, &r, &p).singular_values();
    assert_eq!(singular.iter().filter(|s| **s > 1e-12).count(), 4, "rank of H");
}

/// The three classical metrics and the closed form that they share agree on where to look.
#[test]
fn rivals_agree_with_the_closed_form() {
    let view = at_60_s();
    let (r, height) = (view.lander_in_site_m, view.lander_in_site_m.z);
    let horizontal = Vector3::new(r.x, r.y, 0.0);
    let shared = horizontal * (r.norm() / horizontal.norm());
    let ideal = |s: Selector| s.ideal_landmark_in_site_m(&view, &mut random_stream(0, "test", 0)).expect("above");
    let by_depth = ideal(Selector::DepthError);
    for selector in [Selector::Svd, Selector::Gdop, Selector::Condition] {
        let p = ideal(selector);
        // The search stays in the velocity's vertical plane, off which `shared` lies by a little.
        let loss = 1.0 - metric(Metric::ClosedForm, &r, &p) / metric(Metric::ClosedForm, &r, &shared);
        assert!((0.0..2e-3).contains(&loss), "{selector:?} loses {loss} at {p}");
        let apart = (p - by_depth).norm() / height;
        assert!((0.05..0.25).contains(&apart), "{selector:?} is {apart} heights from the depth error's point");
    }
    for p in [by_depth, shared, Vector3::new(0.0, 500.0, 0.0)] {
        let exact = metric(Metric::SingularValue, &r, &p).powi(2);
        assert!((metric(Metric::ClosedForm, &r, &p) / exact - 1.0).abs() < 1e-2);
        let turned = UnitQuaternion::from_euler_angles(0.5, 0.2, -1.0);
        let singular = bearing_matrix(&turned, &r, &p).singular_values();
        let mut sorted: Vec<f64> = singular.iter().copied().collect();
        sorted.sort_by(f64::total_cmp);
        assert!((sorted[2] / exact.sqrt() - 1.0).abs() < 1e-9, "the attitude must not matter");
    }
}

/// The covariance metric prefers its own choice to the others', and more information never hurts.
#[test]
fn covariance_choice_is_the_best_of_all() {
    let view = at_60_s();
    let cost = |s: Selector| {
        let p = s.ideal_landmark_in_site_m(&view, &mut random_stream(1, "test", 0)).expect("above");
        posterior_position_variance_m2(&view, &p)
    };
    let best = cost(Selector::Covariance);
    let prior = view.covariance.fixed_view::<3, 3>(0, 0).trace();
    for selector in [Selector::DepthError, Selector::Svd, Selector::Random] {
        let other = cost(selector);
        assert!(best <= other && other < prior, "{selector:?}: {best} {other} {prior}");
    }
}

#[test]
fn random_choice_is_seeded_and_within_its_cone() {
    let view = at_60_s();
    let draw =
        |index| Selector::Random.ideal_landmark_in_site_m(&view, &mut random_stream(7, "test", index)).expect("above");
    assert_eq!(draw(3), draw(3));
    assert_ne!(draw(3), draw(4));
    for index in 0..200 {
        let off_nadir = (draw(index) - view.lander_in_site_m).angle(&-Vector3::z());
        assert!(off_nadir <= 45.0_f64.to_radians() + 1e-12);
    }
    assert_eq!(Selector::None.ideal_landmark_in_site_m(&view, &mut random_stream(7, "test", 0)), None);
}

#[test]
fn ground_point_is_clamped_off_nadir() {
    let view = at_60_s();
    let p = view.ground_point_in_site_m(&Vector3::new(1.0, 0.0, -0.01)).expect("above");
    let relative = p - view.lander_in_site_m;
    assert!((relative.angle(&-Vector3::z()).to_degrees() - 70.0).abs() < 1e-9);
    assert!(relative.x > 0.0 && relative.y.abs() < 1e-9 && p.z.abs() < 1e-9);
    let mut buried = view;
    buried.lander_in_site_m.z = -1.0;
    assert_eq!(buried.ground_point_in_site_m(&-Vector3::z()), None);
}

#[test]
fn nearest_surviving_candidate_is_chosen() {
    let direction = |x: f64| Unit::new_normalize(Vector3::new(x, 0.0, -1.0));
    let candidates: Vec<Candidate> = [(5, 0.5), (6, 0.11), (7, 0.2), (8, -0.1)]
        .map(|(track_id, x)| Candidate { track_id, direction_in_site: direction(x) })
        .to_vec();
    let ideal = direction(0.1);
    assert_eq!(choose(&ideal, &candidates, |_| true).expect("one").track_id, 6);
    assert_eq!(choose(&ideal, &candidates, |c| c.track_id != 6).expect("one").track_id, 7);
    assert_eq!(choose(&ideal, &candidates, |_| false), None);
}

#[test]
fn selectors_are_spelled_as_on_the_command_line() {
    for name in ["depth-error", "svd", "gdop", "condition", "covariance", "random", "none"] {
        let selector: Selector = serde_json::from_value(name.into()).expect(name);
        assert_eq!(serde_json::to_value(selector).expect("plain"), name);
    }
}

/// The optimum that the classical metrics share, in closed form: no ground point on the line of the lander has a larger λ4
/// by more than the search's grain.
#[test]
fn lambda4_closed_form_is_its_maximum() {
    for view in [at_start(), at_60_s()] {
        let point_m =
            Selector::Lambda4.ideal_landmark_in_site_m(&view, &mut random_stream(0, "test", 0)).expect("above");
        let best = metric(Metric::ClosedForm, &view.lander_in_site_m, &point_m);
        let course = Vector3::new(view.lander_in_site_m.x, view.lander_in_site_m.y, 0.0).normalize();
        for k in -200..=200 {
            let other_m = course * (f64::from(k) * 60.0);
            let value = metric(Metric::ClosedForm, &view.lander_in_site_m, &other_m);
            assert!(value <= best * (1.0 + 1e-9), "{value} at {other_m} against {best} at {point_m}");
        }
    }
}

/// Three epochs tell all but a turn about the vertical: 11 of 12 singular values, the null vector yaw.
#[test]
fn three_epochs_leave_yaw_alone_unknown() {
    let view = at_60_s();
    let point_m = Vector3::new(1439.428, 3308.203, 0.0);
    let stacked = stacked_bearings(&view, &point_m);
    let mut singular = stacked.singular_values();
    singular.as_mut_slice().sort_by(|a, b| b.total_cmp(a));
    assert!(singular[11] < 1e-9 * singular[0] && singular[10] > 1e-9 * singular[0], "{singular}");
    let least = scaled_metric(Metric::SingularValue, &view, &point_m);
    assert!((least / singular[10] - 1.0).abs() < 1e-9);
    assert!(scaled_metric(Metric::Dilution, &view, &point_m) < least * least);
    assert!((scaled_metric(Metric::Condition, &view, &point_m) - least / singular[0]).abs() < 1e-12);
}

/// Every word names its selector, in files too.
#[test]
fn selectors_have_their_words() {
    for selector in Selector::ALL {
        assert_eq!(serde_json::to_string(&selector).expect("plain"), format!("\"{}\"", selector.word()));
    }
}
