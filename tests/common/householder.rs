//! Least squares by Householder reflections: no normal equations, so nothing is squared that need not be.

/// `A = Q R P`, with rows sorted by size and columns chosen by what is left of them: then rows may be of very different sizes
/// (Cox & Higham 1998).
pub struct Factored {
    /// Upper triangle, and `Qᵀ b`.
    upper: Vec<Vec<f64>>,
    right: Vec<f64>,
    order: Vec<usize>,
    /// The squared lengths of the columns.
    sizes: Vec<f64>,
    /// `min |A x − b|²`
    pub left: f64,
}

/// Factors rows of left-hand sides and a right-hand side.
pub fn factored(rows: &[Vec<f64>]) -> Factored {
    let n = rows[0].len() - 1;
    let size = |row: &&Vec<f64>| row[..n].iter().fold(0.0f64, |size, x| size.max(x.abs()));
    let mut rows: Vec<&Vec<f64>> = rows.iter().collect();
    rows.sort_by(|a, b| size(b).total_cmp(&size(a)));
    let mut columns: Vec<Vec<f64>> = (0..=n).map(|k| rows.iter().map(|row| row[k]).collect()).collect();
    let sizes = columns[..n].iter().map(|column| column.iter().map(|x| x * x).sum()).collect();
    let mut order: Vec<usize> = (0..n).collect();
    let m = rows.len();
    for k in 0..n.min(m) {
        let rest = |column: &[f64]| column[k..].iter().map(|x| x * x).sum::<f64>();
        let pivot = (k..n).max_by(|&a, &b| rest(&columns[a]).total_cmp(&rest(&columns[b]))).unwrap();
        columns.swap(k, pivot);
        order.swap(k, pivot);
        let norm = rest(&columns[k]).sqrt();
        if norm == 0.0 {
            break;
        }
        let head = if columns[k][k] > 0.0 { -norm } else { norm };
        let mut mirror = columns[k][k..].to_vec();
        mirror[0] -= head;
        let half = mirror.iter().map(|x| x * x).sum::<f64>() / 2.0;
        for column in &mut columns[k..] {
            let share = column[k..].iter().zip(&mirror).map(|(x, m)| x * m).sum::<f64>() / half;
            column[k..].iter_mut().zip(&mirror).for_each(|(x, m)| *x -= share * m);
        }
        columns[k][k..].fill(0.0);
        columns[k][k] = head;
    }
    let at = |row: usize, column: &Vec<f64>| column.get(row).copied().unwrap_or(0.0);
    let upper = (0..n).map(|row| columns[..n].iter().map(|column| at(row, column)).collect()).collect();
    let right = (0..n).map(|row| at(row, &columns[n])).collect();
    let left = columns[n].iter().skip(n).map(|x| x * x).sum();
    Factored { upper, right, order, sizes, left }
}

impl Factored {
    /// `x` with `R x = b`, in the order of the columns of `A`; zero where nothing determines it.
    fn back(&self, b: &[f64]) -> Vec<f64> {
        let n = b.len();
        let mut x = b.to_vec();
        for k in (0..n).rev() {
            let known: f64 = (k + 1..n).map(|later| self.upper[k][later] * x[later]).sum();
            x[k] = if self.upper[k][k] == 0.0 { 0.0 } else { (x[k] - known) / self.upper[k][k] };
        }
        let mut sorted = vec![0.0; n];
        self.order.iter().zip(x).for_each(|(&place, x)| sorted[place] = x);
        sorted
    }

    pub fn solution(&self) -> Vec<f64> {
        self.back(&self.right)
    }

    /// `log √(det AᵀA)`
    pub fn log_determinant(&self) -> f64 {
        (0..self.right.len()).map(|k| self.upper[k][k].abs().ln()).sum()
    }

    /// The diagonal of `(AᵀA)⁻¹`: what the columns of `R⁻¹` contribute.
    pub fn variances(&self) -> Vec<f64> {
        let n = self.right.len();
        let mut sums = vec![0.0; n];
        for k in 0..n {
            let mut one = vec![0.0; n];
            one[k] = 1.0;
            sums.iter_mut().zip(self.back(&one)).for_each(|(sum, x)| *sum += x * x);
        }
        sums
    }

    /// The square of the condition, however columns are scaled: `Σ |aₖ|² (AᵀA)⁻¹ₖₖ`.
    pub fn squared_condition(&self) -> f64 {
        self.variances().iter().zip(&self.sizes).map(|(variance, size)| variance * size).sum()
    }

    /// `aᵀ (AᵀA)⁻¹ a` for a row `a` of `A`: how much of that row's right-hand side the solution follows.
    pub fn leverage(&self, row: &[f64]) -> f64 {
        let n = self.right.len();
        let mut y: Vec<f64> = self.order.iter().map(|&place| row[place]).collect();
        for k in 0..n {
            let known: f64 = (0..k).map(|before| self.upper[before][k] * y[before]).sum();
            y[k] = (y[k] - known) / self.upper[k][k];
        }
        y.iter().map(|y| y * y).sum()
    }
}

/// The smallest part of a column that does not depend on the columns before it, the right-hand side not counted.
pub fn least_independent(rows: &[Vec<f64>]) -> f64 {
    let n = rows[0].len() - 1;
    let mut columns: Vec<Vec<f64>> = (0..n).map(|k| rows.iter().map(|row| row[k]).collect()).collect();
    let product = |a: &[f64], b: &[f64]| a.iter().zip(b).map(|(a, b)| a * b).sum::<f64>();
    let whole: Vec<f64> = columns.iter().map(|column| product(column, column).sqrt()).collect();
    let mut least = 1.0f64;
    for k in 0..n {
        let rest = product(&columns[k], &columns[k]).sqrt();
        least = least.min(rest / whole[k]);
        let direction: Vec<f64> = columns[k].iter().map(|x| x / rest).collect();
        for later in &mut columns[k + 1..] {
            let share = product(&direction, later);
            later.iter_mut().zip(&direction).for_each(|(x, d)| *x -= share * d);
        }
    }
    least
}
